"""Validates result files by the schema that the program prints.

    validate.py DSDPV1_SIM RESULT...     of run
"""
import json
import subprocess
import sys

import jsonschema


def validator(program, which="--result"):
    schema = json.loads(subprocess.run([program, "schema", which], check=True, capture_output=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def faults(judge, result):
    return ["%s: %s" % (error.json_path, error.message) for error in judge.iter_errors(result)]


def main(program, *paths):
    judge = validator(program)
    lines = []
    for path in paths:
        with open(path, encoding="UTF-8") as file:
            lines += ["%s: %s" % (path, fault) for fault in faults(judge, json.load(file))]
    return "\n".join(lines[:20]) or None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
