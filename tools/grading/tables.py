"""The results for other programs: a spreadsheet, Moodle, Gradescope, a forge."""

import csv
import io
import json
import re
from xml.etree import ElementTree

from tools.grading.page import message_of
from tools.tree import write_whole

CONTROL = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def cell(text):
    """A spreadsheet takes what begins so for a formula."""
    text = str(text)
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text


def as_csv(rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([map(cell, row) for row in rows])
    return text.getvalue()


def points(whole):
    """A row for each student, a column for each exercise."""
    first = next(iter(whole.results.values()))
    rows = [["id", "name", "state", "points", "out of", *(one["number"] for one in first["exercises"])]]
    for one in whole.submissions:
        result = whole.results[one.name]
        each = [row["points"] for row in result["exercises"]]
        rows.append([one.name, one.student, result["state"], result["points"], result["out_of"], *each])
    return as_csv(rows)


def moodle(whole):
    """For Moodle's "Grades, Import, CSV file", which asks what each column is: the roster's,
    and the grades. Who handed in nothing has none, and who is not in the roster no row."""
    head = ["Grade", "Maximum grade", "Feedback comments"]
    rows = [[*(columns := whole.given.columns or ["Submission"]), *head]]
    for one in whole.submissions:
        result, cells = whole.results[one.name], list(one.row)
        if not whole.given.columns:
            cells = [one.name]
        elif not cells:
            continue
        cells += [""] * (len(columns) - len(cells))
        grade = result["points"] if one.path else ""
        rows.append([*cells[: len(columns)], grade, result["out_of"], message_of(result)])
    return as_csv(rows)


def gradescope(result):
    """A results.json of Gradescope's autograder."""
    return {
        "score": result["points"],
        "output": message_of(result),
        "tests": [
            {
                "number": row["number"],
                "name": row["title"],
                "score": row["points"],
                "max_score": row["out_of"],
                "status": "passed" if row["points"] else "failed",
                "output": row["message"] or row["state"],
            }
            for row in result["exercises"]
        ],
    }


def junit(whole):
    """A suite for each student, a test for each exercise."""
    root = ElementTree.Element("testsuites")

    def plain(text):
        return CONTROL.sub("?", str(text))

    for one in whole.submissions:
        result = whole.results[one.name]
        failed = sum(not row["points"] for row in result["exercises"])
        suite = ElementTree.SubElement(
            root, "testsuite", name=plain(one.name), tests=str(len(result["exercises"])), failures=str(failed)
        )
        for row in result["exercises"]:
            case = ElementTree.SubElement(
                suite, "testcase", classname=plain(one.name), name=f"{row['number']} {row['title']}"
            )
            if not row["points"]:
                failure = ElementTree.SubElement(case, "failure", message=row["state"])
                failure.text = plain(row["message"] or message_of(result))
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def write(whole):
    write_whole(whole.folder / "points.csv", points(whole))
    write_whole(whole.folder / "moodle.csv", moodle(whole))
    write_whole(whole.folder / "junit.xml", junit(whole))
    for one in whole.submissions:
        text = json.dumps(gradescope(whole.results[one.name]), indent=1)
        write_whole(whole.place(one) / "results.json", text)
