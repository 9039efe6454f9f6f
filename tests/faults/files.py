"""Faults of files: a full disk, files that may not be written or replaced, names. Each modifies the place's output and returns the remaining
files, the exit code, the line."""
import os

from commands import SCENARIO
from place import check
from whole import read, same


def full_at_start(place):
    return place.do(faults="fsize=0")


def full_in_the_middle(place):
    place.make()
    return place.do(faults="fsize=%d" % (len(place.output.reference) // 2))


def full_at_the_last_byte(place):
    return place.do(faults="fsize=%d" % (len(place.output.reference) - 1))


def full_device(place):
    os.symlink("/dev/full", place.file())
    return place.do()


def folder_not_writable(place):
    os.mkdir(place.file("folder"), 0o555)
    row = place.do(os.path.join("folder", place.output.file), faults="user")
    check(not os.listdir(place.file("folder")), "something was written")
    return row


def file_not_writable(place):
    place.make()
    os.chmod(place.file(), 0o444)
    return place.do(faults="user")


def is_a_folder(place):
    os.mkdir(place.file())
    return place.do()


def refused(place, words, before):
    """The output is an existing file that is not a copy of it: it must stay unchanged."""
    place.inputs.add(place.output.file)
    row = place.end(place.start(words))
    check(read(place.file()) == before, "it was replaced")
    check(row[0] == "nothing", "there is " + row[0])
    return ["FILE as before", *row[1:]]


def own_scenario(place):
    os.rename(place.file("s.yaml"), place.file())
    words = [word if word != "s.yaml" else place.output.file for word in place.output.command()]
    return refused(place, words, SCENARIO.encode())


def other_input(place):
    """By a symbolic and by a hard link."""
    rows = []
    for link in (os.symlink, os.link):
        link(place.file(place.output.other_input), place.file())
        rows.append(refused(place, place.output.command(), read(place.file(place.output.other_input))))
        os.remove(place.file())
    check(rows[0] == rows[1], "the kinds of links differ: %s, %s" % tuple(rows))
    return rows[0]


def twice(place):
    """By another spelling, or, if the other needs its own ending, a link."""
    same_file = "./" + place.output.file
    if place.output.other == "--difference":
        same_file = "same.vcd"
        os.symlink(place.output.file, place.file(same_file))
        place.inputs.add(same_file)
    return place.do(more=[place.output.other, same_file])


def link(place):
    os.mkdir(place.file("far"))
    place.make("far/there")
    os.symlink("far/there", place.file())
    row = place.do()
    check(same(read(place.file("far/there")), place.output.reference), "the link's target is not the output")
    return ["the link's target complete, " + row[0].split(", ")[0], *row[1:]]


def dangling_link(place):
    os.symlink("there", place.file())
    row = place.do()
    place.inputs.add("there")
    return [row[0].replace("there", "the link's target"), *row[1:]]


def long_name(place, length):
    ending = os.path.splitext(place.output.file)[1]
    return place.do("n" * (length - len(ending)) + ending)


def name_249(place):
    return long_name(place, 249)


def name_255(place):
    return long_name(place, 255)


def name_256(place):
    return long_name(place, 256)
