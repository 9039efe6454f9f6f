#!/usr/bin/env python3
"""Writes the software bill of materials of an installation as SPDX 2.3 in JSON: programs and libraries with their SHA-256, the contents of each with
versions and licences, and the tools that built and tested them. Sources: the table of docs/licences.md, which a test compares with the link lines, dpkg
and the lists of PyPI's packages. The same files always give the same text.

    sbom.py OUTPUT VERSION FILE...        missing files are skipped
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import uuid

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "cmake"))

import licence_table  # noqa: E402

PUBLIC_DOMAIN = "Given to the public domain by its authors; see the copyright file of the package."
TEXTS = {"LicenseRef-Public-Domain": PUBLIC_DOMAIN, "LicenseRef-IEEE-1800": "The header as the standard IEEE 1800 prints it, which says that it may be used."}
KINDS = {"linked": "DYNAMIC_LINK", "compiled in": "CONTAINS", "embedded": "CONTAINS", "loaded": "DEPENDS_ON", "run": "DEPENDS_ON"}
LICENCE = "Apache-2.0"
PACKAGE = "SPDXRef-Package-dsdpv1"


def identifier(kind, name):
    return f"SPDXRef-{kind}-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name)


def debian_versions(packages):
    """Maps packages to version and architecture, if they are installed."""
    told = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version} ${Architecture}\\n", *sorted(packages)], capture_output=True, text=True, check=False)
    words = (line.split() for line in told.stdout.splitlines())
    return {each[0]: (each[1], each[2]) for each in words if len(each) == 3}  # a known package that is not installed has no version


def python_versions():
    lists = "".join((ROOT / name).read_text(encoding="utf-8") for name in ("requirements.txt", "requirements-test.txt", "requirements-lint.txt"))
    return dict(re.findall(r"^([\w.-]+)==(\S+)", lists, re.M))


def where_from(name, debian, python):
    """Version and package URL; None if neither has it."""
    if name in python:
        return python[name], f"pkg:pypi/{re.sub(r'[-_.]+', '-', name).lower()}@{python[name]}"
    if name in debian:
        version, architecture = debian[name]
        return version, f"pkg:deb/debian/{name}@{version.replace('+', '%2B').replace(':', '%3A').replace('~', '~')}?arch={architecture}"
    return None


def dependency(here, name, licence, version, url):
    return {"SPDXID": here, "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": url}]}


def built(path):
    """A program or library of the build."""
    return {"SPDXID": identifier("Built", path.name), "name": path.name, "packageFileName": path.name, "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": LICENCE, "licenseDeclared": LICENCE, "copyrightText": "2026 the dsdpv1 authors",
            "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(path.read_bytes()).hexdigest()}]}


def relation(one, kind, other):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}


def relations_of(row, here, files):
    if row.use in ("build", "test"):
        return [relation(here, f"{row.use.upper()}_DEPENDENCY_OF", PACKAGE)]
    return [relation(identifier("Built", file.name), KINDS[row.use], here) for file in files if licence_table.label_of(file.name) in row.into]


def seconds_of_commit():
    """The commit time of the sources; 0 without Git."""
    return int(subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%ct"], capture_output=True, text=True, check=False).stdout.strip() or 0)


def created():
    """The commit time of the built sources, or SOURCE_DATE_EPOCH (https://reproducible-builds.org/specs/source-date-epoch/)."""
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH") or seconds_of_commit())
    return datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def document(version, files):
    rows = licence_table.rows_of((ROOT / licence_table.PAGE).read_text(encoding="utf-8"))
    debian, python = debian_versions({name for row in rows for name in row.packages}), python_versions()
    packages = [{"SPDXID": PACKAGE, "name": "dsdpv1", "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
                 "licenseConcluded": LICENCE, "licenseDeclared": LICENCE, "copyrightText": "2026 the dsdpv1 authors"}]
    relations = [relation("SPDXRef-DOCUMENT", "DESCRIBES", PACKAGE)]
    for file in files:
        packages.append(built(file))
        relations.append(relation(PACKAGE, "CONTAINS", identifier("Built", file.name)))
    for number, row in enumerate(rows):  # a package can have several, each with its licence
        for name in row.packages:
            here = identifier("Dependency", f"{number}-{name}")
            origin, found = where_from(name, debian, python), relations_of(row, here, files)
            if origin and found:
                packages.append(dependency(here, name, row.licence, *origin))
                relations += found
    content = {"packages": packages, "relationships": relations,
               "hasExtractedLicensingInfos": [{"licenseId": name, "extractedText": text} for name, text in TEXTS.items()]}
    name = f"dsdpv1-{version}"
    unique = uuid.uuid5(uuid.NAMESPACE_DNS, json.dumps(content, sort_keys=True))
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
            "documentNamespace": f"https://dsdpv1.invalid/spdx/{name}-{unique}", "creationInfo": {"created": created(), "creators": ["Tool: dsdpv1-sbom"]}, **content}


def write(output, version, files):
    output.write_text(json.dumps(document(version, files), indent=1) + "\n", encoding="utf-8")


def main():
    write(pathlib.Path(sys.argv[1]), sys.argv[2], [pathlib.Path(word) for word in sys.argv[3:] if pathlib.Path(word).is_file()])


if __name__ == "__main__":
    main()
