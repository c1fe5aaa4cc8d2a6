# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The commands that a page offers: they work, they are whole when copied, and what cannot be done is said."""
import json
import os
import shlex
import unittest

from page_support import CASES, SQUARE, PageTest


class Commands(PageTest):
    cases = CASES | {"large/many": SQUARE.format(more="", target="", draw="[[draw.attribute]]\nvalues = [0, 1, 2, 3, 4, 5]").replace("[8, 8]", "[256, 256]")} | {f"ends/{name}": SQUARE.format(more="", target="", draw="") for name in ("segv", "lost")}
    fault = "flip-pixel@family/*,flip-pixel@large/*,flip-pixel@samples/*,flip-pixel@texels/*,segv@ends/segv,device-lost@ends/lost"
    settings = f"EDGECASE_FAULT='{fault}' LP_NUM_THREADS=1 "

    @classmethod
    def make_run(cls):
        os.environ["LP_NUM_THREADS"] = "1"  # a setting that the rerun line repeats
        cls.addClassCleanup(os.environ.pop, "LP_NUM_THREADS")
        super().make_run()
        cls.results = {c["id"]: c for c in json.loads((cls.out / "results.json").read_text(encoding="utf-8"))["cases"]}

    def case(self, case_id, **window):
        return self.open("#case=" + case_id.replace("/", "%2F"), **window)

    def commands(self, page):
        return page.run("Object.fromEntries([...document.querySelectorAll('.command')].map((c) => [c.firstChild.innerText, c.children[1].innerText]))")

    def test_a_reproducer_is_offered_where_one_can_be_written(self):
        for case_id in self.results:
            told = self.commands(self.case(case_id))["reproducer"]
            if case_id == "texels/blit":
                self.assertEqual(told, "none: the case has a blit, which such a program cannot draw")
                self.edgecase("export", "--reproducer", case_id, "-o", self.folder / "repro.c", check=2)
            else:
                words = shlex.split(told)
                self.assertEqual(words[1:], ["export", "--reproducer", case_id, "--suite", str(self.folder / "suite"), "-o", "repro.c"])
                self.edgecase(*words[1:])

    def test_what_may_be_too_large_is_said_beside_the_command(self):
        for case_id in self.results:
            told = "The case has many values, perhaps too many for one program; the command says so."
            self.assertEqual(told in self.case(case_id).text(".columns"), case_id == "large/many", case_id)

    def test_a_crash_tells_how_to_debug_it(self):
        page = self.case("ends/segv")
        self.assertEqual(self.commands(page)["debug"], self.results["ends/segv"]["rerun"].removeprefix(self.settings) + " --debugger gdb")
        for case_id in ("ends/lost", "family/wrong"):
            self.assertNotIn("debug", self.commands(self.case(case_id)))

    def test_settings_stand_once_and_are_copied_with_each_command(self):
        for width in (360, 1400):
            page = self.case("ends/segv", width=width)
            commands = self.commands(page)
            self.assertEqual(commands["settings"].split("\n"), [self.settings.strip(), "in front of rerun and debug, copied with them"])
            self.assertEqual(page.run("document.documentElement.scrollWidth - innerWidth"), 0)
            self.assertGreater(min(page.run("[...document.querySelectorAll('.command code')].map((c) => c.offsetWidth)")), 100)
            self.assertEqual(sum("LP_NUM_THREADS" in text for text in commands.values()), 1, commands)
            page.run("window.addEventListener('copy', (event) => { window.copied = event.clipboardData.getData('text/plain'); })")
            rerun = self.results["ends/segv"]["rerun"]
            self.assertTrue(rerun.startswith(self.settings))
            for label, whole in (("rerun", rerun), ("debug", rerun + " --debugger gdb"), ("reproducer", commands["reproducer"])):
                page.click_seen(f"button[aria-label='copy the {label} command']")
                self.assertEqual(page.run("window.copied"), whole)
            self.assertEqual(page.text("button[aria-label='copy the rerun command']"), "copied")

    def test_causes_copy_the_rerun_of_their_smallest_case(self):
        page = self.open()
        page.run("window.addEventListener('copy', (event) => { window.copied = event.clipboardData.getData('text/plain'); })")
        self.assertNotIn("LP_NUM_THREADS", page.text("#causes"))
        for k, case_id in enumerate(page.run("[...document.querySelectorAll('#causes td:last-child a')].map((a) => a.innerText)")):
            page.click_seen(f"#causes tbody tr:nth-child({k + 1}) td:last-child button")
            self.assertEqual(page.run("window.copied"), self.results[case_id]["rerun"])

    def test_a_copy_that_is_not_allowed_shows_the_whole_command(self):
        page = self.case("family/wrong")
        page.run("document.execCommand = () => false")
        page.click_seen("button[aria-label='copy the rerun command']")
        self.assertEqual(page.run("getSelection().toString()"), self.results["family/wrong"]["rerun"])
        self.assertEqual(page.text("button[aria-label='copy the rerun command']"), "selected")


if __name__ == "__main__":
    unittest.main()
