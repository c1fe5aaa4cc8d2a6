# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Which cases selectors take."""
import re
import unittest

from support import CASE, ProgramTest


class Selection(ProgramTest):
    def test_what_is_not_selected_is_not_read(self):
        """Of the other files of the suite a run of some cases reads names and matrices alone."""
        self.write_case("fam/c4", CASE.format(n=4).replace("[target]", "[target]\nsizes = 3"))
        self.run_suite("fam/c3", check=0)
        self.assertEqual(self.statuses(), {"fam/c3": "pass"})
        for words in ((), ("fam/c3", "fam/c4")):
            self.assertIn("[target] has no key \"sizes\"", self.run_suite(*words, check=3).stderr)

    def order(self, *words):
        self.run_suite(*words, check=0)
        return [c["id"] for c in self.results()["cases"]]

    def test_shuffle_is_repeatable_and_keeps_subsets_in_order(self):
        first = self.order("--shuffle", "--seed", "7")
        self.assertEqual(sorted(first), self.ids)
        self.assertNotEqual(first, self.ids)
        self.assertEqual(self.order("--shuffle", "--seed", "7"), first)
        self.assertNotEqual(self.order("--shuffle", "--seed", "8"), first)
        part = self.order("--shuffle", "--seed", "7", "fam/c1", "fam/c4", "fam/c6", "fam/c9")
        self.assertEqual(part, [i for i in first if i in part])

    def test_shards_partition(self):
        seen = []
        for shard in (1, 2, 3):
            seen += self.order("--shard", f"{shard}/3")
        self.assertEqual(sorted(seen), self.ids)

    def test_quick_takes_the_first_and_the_last_leaf_of_each_file(self):
        (self.suite / "fam/leaves.toml").write_text(
            (self.suite / "fam/c1.toml").read_text().replace("[target]", "[matrix]\nn = [0, 90, 180, 270]\n[target]", 1)
            .replace("[[draw]]", '[[draw]]\nrotate = "n"', 1))
        leaves = [f"fam/leaves:n={n}" for n in (0, 90, 180, 270)]
        self.assertEqual(sorted(self.order("--quick")), sorted(self.ids + [leaves[0], leaves[3]]))
        self.assertEqual(self.order("--quick", "fam/leaves"), [leaves[0], leaves[3]])
        self.assertEqual(self.order("--quick", leaves[1]), [leaves[1]])
        self.assertEqual(self.order("fam/leaves"), leaves)

    def test_failed_in(self):
        self.run_suite(fault="segv@fam/c3,flip-pixel@fam/c5", check=1)
        again = self.folder / "again"
        self.run_suite("--failed-in", self.out, out=again, check=0)
        self.assertEqual(set(self.statuses(again)), {"fam/c3", "fam/c5"})
        self.run_suite("--failed-in", again, check=4)

    def test_failed_in_forgets_no_case_of_ones_own(self):
        (self.folder / "mine.toml").write_text(CASE.format(n=0))
        self.run_suite("fam/c3", "mine.toml", fault="flip-pixel@fam/c3,flip-pixel@mine", check=1)
        again = self.folder / "again"
        done = self.run_suite("--failed-in", self.out, out=again, check=4)
        self.assertEqual(done.stderr, f"edgecase: 1 case that failed in '{self.out}' is not selected: 'mine' of mine.toml; name files or "
                                      "folders of your own, too, and '**' for the suite's cases\n")
        self.run_suite("--failed-in", self.out, "**", "mine.toml", out=again, check=0)
        self.assertEqual(set(self.statuses(again)), {"fam/c3", "mine"})
        done = self.run_suite("--failed-in", self.out, "mine.toml", out=again, check=0)
        self.assertIn("warning: 1 case that failed in", done.stderr)

    def test_empty_shard(self):
        shards = [self.run_suite("fam/c1", "--shard", f"{k}/4").returncode for k in range(1, 5)]
        self.assertEqual(sorted(shards), [0, 4, 4, 4])

    def test_folder_outside_the_suite(self):
        for name in ("a", "sub/b"):
            (self.folder / "mine" / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / "mine" / f"{name}.toml").write_text(CASE.format(n=0))
        done = self.run_suite("mine/", fault="flip-pixel@sub/b", check=1)
        self.assertEqual(self.statuses(), {"a": "pass", "sub/b": "fail"})
        # The line to draw it again names the file, which needs no --suite.
        rerun = re.search(r"rerun: (?:\w+=\S+ )*\S+ run (.*)", done.stdout).group(1).split()
        self.assertEqual(rerun[0], "mine/sub/b.toml")
        self.run_suite(*rerun, fault="flip-pixel", check=1)
        self.assertEqual(self.edgecase("list", "--ids", "mine", "fam/c1", check=0).stdout.split(), ["fam/c1", "a", "sub/b"])
        # A folder that holds the suite is none of one's own.
        self.assertEqual(self.edgecase("list", "--ids", "cases", check=0).stdout.split(), self.ids)
        # One that holds files of one's own, too, would leave them out.
        self.assertIn("holds the suite and 2 case files beside it (./mine/a.toml), which would be left out",
                      self.edgecase("list", "--ids", ".", check=2).stderr)
        self.write_case("a", CASE.format(n=0))
        self.assertIn("mine/a.toml: error: its id 'a' is already that of",
                      self.edgecase("list", "mine", check=3).stderr)

    def test_a_file_of_ones_own_draws_no_case_of_the_suite(self):
        """A file of one's own whose name means something else to a selector chooses itself alone; that of a suite's file is refused."""
        leaves = CASE.format(n=0).replace("[target]", "[matrix]\nfirst = [{}]\n[target]").replace("[[draw]]", '[[draw]]\nfirst = "first"')
        self.write_case("fam/leaves", leaves.format("0, 1"))
        own = self.folder / "mine" / "fam" / "leaves.toml"
        own.parent.mkdir(parents=True)
        for text in (CASE.format(n=0), leaves.format("2")):
            own.write_text(text)
            for words in (["run", "--renderer=reference"], ["list"]):
                self.assertIn(f"mine/fam/leaves.toml: error: its id 'fam/leaves' is already that of {self.suite}/fam/leaves.toml; rename",
                              self.edgecase(*words, "mine", check=3).stderr)
        own.unlink()
        for name in ("-", "fam"):
            only = self.folder / "mine" / f"{name}.toml"
            only.write_text(CASE.format(n=0))
            self.assertEqual(self.edgecase("list", "--ids", "mine", check=0).stdout.splitlines(), [name])
            only.unlink()
        only.write_text(CASE.format(n=0))
        # What an exclusion takes out stays out, and beside it alone the suite is not meant.
        self.assertEqual(self.edgecase("list", "--ids", "mine", "!fam/c1", check=0).stdout.splitlines(), ["fam"])
        self.assertEqual(self.edgecase("list", "--ids", "mine", "fam/c1", "!fam", check=0).stdout.splitlines(), ["fam/c1"])
        self.assertEqual(self.edgecase("list", "mine/fam.toml", "./mine/fam.toml", check=2).stderr,
                         "edgecase: the file ./mine/fam.toml is named twice; name it once\n")

    def test_file_outside_the_suite(self):
        (self.folder / "mine.toml").write_text((self.suite / "fam/c1.toml").read_text())
        self.run_suite("mine.toml", check=0)
        self.assertEqual(self.statuses(), {"mine": "pass"})


if __name__ == "__main__":
    unittest.main()
