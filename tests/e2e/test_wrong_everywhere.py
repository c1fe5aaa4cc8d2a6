# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What a driver that is wrong everywhere is told: the first look, all of some failures and the symptoms of the others,
causes over families, and the lines at the end."""
import json
import unittest

from support import ProgramTest

# So many leaves that a run begins with the plainest of each family.
MANY = """format = 1
description = "Triangles, number {n}."
rules = ["cover.inside"]
[matrix]
k = [%s]
[target]
size = [8, 8]
[[draw]]
vertices = [[1,1], [7,1], [1,"7-k/256"]]
[[draw.attribute]]
plane = ["x/8"]
""" % ", ".join(str(k) for k in range(100))
FAMILIES = ("one", "two", "three")
PLAIN = "one/many:k=0"  # of as many samples and vertices as all others: the first by id


class WrongEverywhere(ProgramTest):
    def setUp(self):
        super().setUp()
        for n, family in enumerate(FAMILIES):
            self.write_case(f"{family}/many", MANY.format(n=n))

    def records(self, out=None):
        return {case["id"]: case for case in self.results(out)["cases"]}

    def test_the_first_look(self):
        done = self.run_suite("--retries", "0", "--no-expect", fault="flip-pixel", check=1)
        lines = done.stdout.splitlines()
        self.assertRegex(lines[1], r"^first look, after \S+ m?s: 64 of 64 cases fail that are the plainest of their families$")
        told = "\n".join(lines[:lines.index("the run goes on; Ctrl-C ends it with reports of what was judged")])
        self.assertRegex(told, r"\nsmallest case:\nFAIL \S+   1 \w+")
        self.assertIn("\n      pixels (0,0) to (7,7): # covered, ", told)
        self.assertIn("\n      rerun: ", told)
        self.assertTrue(lines[-3].startswith("vulkan: 310 of 310 cases are wrong ("), lines[-3])
        self.assertRegex(lines[-2], r"^smallest case: \S+   rerun: EDGECASE_FAULT=flip-pixel \S*edgecase run ")
        self.assertTrue(lines[-1].startswith(f"report {self.out}/report.html    exit 1"), lines[-1])

    def test_a_few_failures_are_no_news_before_the_end(self):
        done = self.run_suite("--no-expect", fault="flip-pixel@one/*,flip-pixel@fam/*", check=1)
        self.assertNotIn("first look", done.stdout)
        done = self.edgecase("run", "--renderer=reference", "-o", self.out, "-q", "--no-expect", fault="flip-pixel", check=1)
        self.assertNotIn("first look", done.stdout)

    def test_symptoms_alone_beyond_those_that_are_told(self):
        words = ("--no-expect", "-j1", "--batch", "1")
        self.run_suite(*words, "--tell", "20", fault="flip-pixel", check=1)
        few = self.records()
        self.run_suite(*words, "--tell", "all", fault="flip-pixel", check=1, out=self.folder / "all")
        every = self.records(self.folder / "all")
        brief = {k for k, case in few.items() if case["brief"]}
        self.assertEqual({case["brief"] for case in every.values()}, {False})
        # Those of the first look are told, too, and what is drawn before the twentieth is judged: on a busy machine much.
        self.assertTrue(0 < len(brief) <= 310 - 64, len(brief))
        self.assertNotIn(PLAIN, brief)
        for case_id, case in few.items():
            self.assertEqual((case["status"], case["level"], case["bits"]),
                             ("fail", every[case_id]["level"], every[case_id]["bits"]), case_id)
            is_brief = case_id in brief
            self.assertEqual((case["pictures"] is None, case["attempts"], bool(case["explain"])),
                             (is_brief, 1 if is_brief else 2, not is_brief), case_id)
            if is_brief:
                self.assertEqual(len(case["findings"]), 1)
                self.assertIn(case["findings"][0], every[case_id]["findings"])
        # How often a brief one breaks a rule is not known, so no line can be made of it.
        done = self.edgecase("expect", self.folder / "new.txt", "--update", self.out, "--bug", "b#1", check=3)
        self.assertEqual(done.stderr.strip(), f"edgecase: the run knows of {len(brief)} failures no more than their symptoms, and a line "
                                              "says how often a case breaks each rule; run again with --tell all")
        self.edgecase("expect", self.folder / "new.txt", "--update", self.folder / "all", "--bug", "b#1", check=0)
        # Nor is it a change to another run.
        done = self.edgecase("compare", self.folder / "all", self.out, check=0)
        self.assertIn("310", done.stdout)
        # What is brief takes little room.
        lines = {True: [], False: []}
        for line in (self.out / "journal.jsonl").read_text(encoding="utf-8").splitlines():
            record = json.loads(line)
            if record["record"] == "end":
                lines[record.get("brief", False)].append(len(line))
        self.assertLess(2 * max(lines[True]), min(lines[False]))

    def test_one_cause_of_all_families(self):
        self.run_suite("--no-expect", fault="flip-pixel", check=1)
        causes = json.loads((self.out / "results.json").read_text(encoding="utf-8"))["causes"]
        self.assertEqual(sorted(family for cause in causes for family in cause["families"] if len(cause["families"]) > 1),
                         ["fam", "one", "three", "two"])

    def test_a_run_without_pictures_is_told_from_an_unknown_error(self):
        for words, told in ((["--capture", "none"], "no diagnosis: the run kept no picture of a failure; draw it again without --capture none\n"),
                            ([], "no diagnosis: no known error fails as the device did in the cases that were tried\n")):
            self.run_suite("--no-expect", "fam/c0", *words, fault="shift-value", check=1)
            self.assertEqual(self.edgecase("diagnose", self.out, check=0).stdout, told)

    def test_wrong_numbers(self):
        for word in ("some", "-1", "1.5", ""):
            done = self.run_suite("--tell", word, check=2)
            self.assertIn("--tell", done.stderr)


if __name__ == "__main__":
    unittest.main()
