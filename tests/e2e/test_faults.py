# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A broken driver harms only the case that breaks it."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from support import CASE, PROGRAM, ProgramTest, processes_with


class Charging(ProgramTest):
    def charge(self, fault, status, *words):
        done = self.run_suite(*words, fault=f"{fault}@fam/c3", check=1)
        expected = {case_id: "pass" for case_id in self.ids}
        expected["fam/c3"] = status
        self.assertEqual(self.statuses(), expected, done.stdout + done.stderr)
        self.assert_no_orphans()
        return next(c for c in self.results()["cases"] if c["id"] == "fam/c3")

    def test_no_fault_is_a_pass(self):
        self.run_suite(check=0)
        self.assertEqual(set(self.statuses().values()), {"pass"})

    def test_segv(self):
        self.assertIn("SIGSEGV", json.dumps(self.charge("segv", "crash")))

    def test_abort(self):
        self.assertIn("SIGABRT", json.dumps(self.charge("abort", "crash")))

    def test_exit_without_result(self):
        self.charge("exit0", "crash")

    def test_out_of_memory(self):
        self.charge("oom", "crash")

    def test_truncated_result(self):
        self.charge("truncate", "crash")

    def test_garbage(self):
        self.charge("garbage", "crash")

    def test_device_lost(self):
        self.charge("device-lost", "device_lost")

    def test_hang(self):
        self.charge("hang", "timeout", "--timeout", "0.5")

    def test_a_flood_of_output_ends_at_the_time_limit(self):
        case = self.charge("flood", "timeout", "--timeout", "0.5")
        self.assertLess(len(json.dumps(case)), 100_000)

    def test_wrong_pixel(self):
        case = self.charge("flip-pixel", "fail")
        self.assertEqual(case["findings"][0]["kind"], "double")

    def test_wrong_pixel_in_a_derived_rendering(self):
        text = (self.suite / "fam" / "c3.toml").read_text()
        self.write_case("fam/c3", text.replace("[target]", 'relations = ["same-twice", { scissor-tiles = [3, 2] }]\n[target]'))
        case = self.charge("flip-derived", "fail")
        self.assertEqual({f["rule"] for f in case["findings"]}, {"repeat.same", "repeat.scissor"})
        self.assertEqual(len(case["findings"]), 3)

    def test_flake(self):
        self.assertTrue(self.charge("flake", "flake")["rerun"].endswith(" --repeat 2"))

    def test_the_rerun_line_of_a_flake_has_the_larger_repeat(self):
        rerun = self.charge("flake", "flake", "--repeat", "3")["rerun"]
        self.assertEqual(re.findall(r"--repeat (\d+)", rerun), ["3"])

    def test_flake_without_retries_is_a_fail(self):
        self.charge("flake", "fail", "--retries", "0")

    def test_repeat_finds_other_bits(self):
        self.charge("flake", "flake", "--repeat", "3", "--retries", "0")

    def test_two_workers(self):
        self.charge("segv", "crash", "-j", "2", "--batch", "2")

    def test_every_case_alone(self):
        self.charge("segv", "crash", "--batch", "1")

    def test_unsupported_does_not_fail_the_run(self):
        self.run_suite(fault="unsupported@fam/c3", check=0)
        self.assertEqual(self.statuses()["fam/c3"], "unsupported")

    def test_all_unsupported(self):
        self.run_suite(fault="unsupported", check=6)

    def test_case_without_control_sample_is_an_error(self):
        self.write_case("fam/empty", """format = 1
description = "Nothing can be seen."
rules = ["cover.outside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[20,20], [30,20], [20,30]]
""")
        done = self.run_suite()
        if done.returncode != 3:  # refused by the loader already
            self.assertEqual(done.returncode, 7, done.stdout + done.stderr)
            self.assertEqual(self.statuses()["fam/empty"], "error")

    def test_wrong_picture_is_an_error_before_any_device(self):
        picture = "\\n".join(["........"] * 8)
        text = (self.suite / "fam/c3.toml").read_text() + f'[expect]\nhits = "{picture}"\n'
        self.write_case("fam/c3", text)
        self.run_suite(fault="segv@fam/c3", check=7)
        self.assertEqual(self.statuses()["fam/c3"], "error")


class Pictures(ProgramTest):
    def test_a_driver_has_no_descriptor_of_pictures_that_are_judged(self):
        """Locked pages do not help where it can punch holes into the memory behind them."""
        process = subprocess.Popen([PROGRAM, "run", "--renderer=reference", "--batch", "1", "-j", "1", "-o", self.out],
                                   env=self.environment("hang@fam/c8"), cwd=self.folder, stdout=subprocess.DEVNULL)
        journal = self.out / "journal.jsonl"
        while not (journal.exists() and "fam/c8" in journal.read_text().partition("\n")[2]):
            time.sleep(0.01)
        workers = [pid for pid in processes_with(str(self.folder)) if pid != process.pid]
        links = {name: os.readlink(f"/proc/{pid}/fd/{name}") for pid in workers for name in os.listdir(f"/proc/{pid}/fd")}
        mapped = "".join(pathlib.Path(f"/proc/{pid}/maps").read_text() for pid in workers)
        process.terminate()
        process.wait(timeout=60)
        self.assertIn("memfd:", mapped)
        self.assertEqual([link for link in links.values() if "memfd:" in link], [])


class Start(ProgramTest):
    def test_no_device(self):
        done = self.run_suite(fault="no-device", check=5)
        self.assertIn("doctor", done.stderr)

    def test_crash_at_start(self):
        self.assertIn("SIGSEGV", self.run_suite(fault="segv-at-start", check=5).stderr)

    def test_hang_at_start(self):
        self.run_suite("--timeout", "0.5", fault="hang-at-start", check=5)
        self.assert_no_orphans()

    def start_failing(self, failures):
        """A driver that dies of fam/c3, and of so many starts after that: a device that is being reset."""
        count, prefix = self.folder / "count", self.folder / "prefix"
        prefix.write_text(f'n=$(($(cat {count} 2>/dev/null || echo 0) + 1)); echo $n >{count}\n'
                          f'[ $n -eq 1 ] || [ $n -gt {failures + 1} ] || exit 1\nexec "$@"\n')
        env = {**self.environment("segv@fam/c3"), "EDGECASE_SELF_PREFIX": f"/bin/sh {prefix}"}
        return self.edgecase("run", "--renderer=reference", "--jobs", "1", "-o", self.out, env=env)

    def test_a_device_that_is_reset_is_waited_for(self):
        done = self.start_failing(4)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual({i: s for i, s in self.statuses().items() if s != "pass"}, {"fam/c3": "crash"})

    def test_a_device_that_does_not_come_back_ends_the_run(self):
        done = self.start_failing(1000)
        self.assertEqual(done.returncode, 7, done.stdout + done.stderr)
        self.assertIn("workers cannot be started any more", done.stderr)

    def test_a_budget_of_device_time(self):
        self.run_suite("--gpu-budget", "1", check=0)
        self.assertEqual(set(self.statuses().values()), {"pass"})
        self.assertIn("--gpu-budget", self.run_suite("--gpu-budget", "0", check=2).stderr)

    def test_wrong_device(self):
        done = self.run_suite("--require-device", "llvmpipe", check=5)
        self.assertIn("Edgecase reference", done.stderr)
        self.run_suite("--require-device", "Edgecase.*reference", check=0)

    def test_unknown_fault(self):
        self.assertIn("segv", self.run_suite(fault="sgev", check=5).stderr)


class Output(ProgramTest):
    def rerun_of(self, *words, fault, status, env=None):
        """The line of the only case that ended so."""
        self.edgecase("run", "-o", self.out, *words, env=self.environment(fault) | (env or {}), check=1)
        lines = [case["rerun"] for case in self.results()["cases"] if case["status"] == status]
        self.assertEqual(len(lines), 1)
        return lines[0]

    def pasted(self, line, case_id, status, path=None):
        """Pastes a line into a shell of which nothing of the run's settings is known."""
        env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_", "LP_"))} | (path or {})
        again = subprocess.run(["sh", "-c", line + " -o again"], env=env, cwd=self.folder, capture_output=True, text=True,
                               timeout=60, check=False)
        self.assertEqual(again.returncode, 1, line + again.stdout + again.stderr)
        self.assertEqual(self.statuses(self.folder / "again")[case_id], status, line)

    def test_rerun_lines_repeat_the_failure_by_themselves(self):
        for fault, status in (("flip-pixel", "fail"), ("segv", "crash"), ("flake", "flake")):
            with self.subTest(fault):
                line = self.rerun_of("--renderer=reference", fault=f"{fault}@fam/c3", status=status, env={"LP_NUM_THREADS": "1"})
                self.assertTrue(line.startswith(f"EDGECASE_FAULT={fault}@fam/c3 LP_NUM_THREADS=1 {PROGRAM} run fam/c3 "), line)
                self.pasted(line, "fam/c3", status)

    def test_a_file_of_ones_own_and_a_software_device_are_drawn_again(self):
        own = self.folder / "my cases" / "b.toml"
        own.parent.mkdir()
        own.write_text(CASE.format(n=1).replace("[7,1]", "[7.5,1]").replace("[7,7]", "[7.5,7]"))
        line = self.rerun_of(own.relative_to(self.folder), "--renderer=reference", fault="flip-pixel", status="fail")
        self.assertIn(" run 'my cases/b.toml' ", line)
        self.pasted(line, "b", "fail")
        device = "software:ties=bottom-right"
        line = self.rerun_of(own, "--renderer", device, fault="", status="fail")
        self.assertIn(f" --renderer {device}", line)
        self.pasted(line, "b", "fail")

    def test_the_program_is_called_edgecase_where_the_path_finds_it(self):
        folder = self.folder / "bin"
        folder.mkdir()
        other = self.folder / "other"
        other.mkdir()
        (other / "edgecase").write_text("#!/bin/sh\nexit 9\n")
        (other / "edgecase").chmod(0o755)
        (folder / "edgecase").symlink_to(PROGRAM)
        usual = os.environ["PATH"]
        for path, word in ((f"{folder}:{usual}", "edgecase"), (f"{other}:{folder}:{usual}", PROGRAM), (usual, PROGRAM),
                           (f"{folder.parent}/none:{folder}", "edgecase")):
            with self.subTest(path):
                line = self.rerun_of("--renderer=reference", fault="flip-pixel@fam/c3", status="fail", env={"PATH": path})
                self.assertTrue(line.startswith(f"EDGECASE_FAULT=flip-pixel@fam/c3 {word} run fam/c3 "), line)
                self.pasted(line, "fam/c3", "fail", {"PATH": f"{path}:{usual}"})

    def test_bytes_that_break_reports(self):
        self.run_suite(fault="noise@fam/c3,segv@fam/c3", check=1)
        case = next(c for c in self.results()["cases"] if c["id"] == "fam/c3")
        self.assertIn("driver ", json.dumps(case))
        html = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIsNone(re.search(r"\]\]>\s*</script>\s*(&amp;|&|\\u0026) ", html))
        junit = xml.etree.ElementTree.tostring(xml.etree.ElementTree.parse(self.out / "junit.xml").getroot())
        self.assertNotIn(b"\x1b", junit)

    def test_console_shows_no_control_characters(self):
        done = self.run_suite(fault="noise@fam/c3,segv@fam/c3", check=1)
        self.assertNotIn("\x1b", done.stdout)

    def test_full_disk(self):
        done = self.run_suite("--json", "/dev/full", check=7)
        self.assertIn("No space left", done.stderr)

    def test_a_picture_on_a_full_disk(self):
        for name in ("a.png", "a.exr", "a.tif", "a.json"):
            (self.folder / name).symlink_to("/dev/full")
            done = self.edgecase("render", "fam/c1", "-o", self.folder / name, check=7)
            self.assertIn("No space left", done.stderr, name)

    def limited(self, kibibytes, *words):
        """The program where no file may be larger, as on a disk that gets full."""
        done = subprocess.run(["bash", "-c", f'ulimit -f {kibibytes}; exec "$@"', "bash", PROGRAM, *map(str, words)],
                              env=self.environment(), cwd=self.folder, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 7, f"{words}\n{done.stdout}{done.stderr}")
        self.assertIn("File too large", done.stderr, words)

    def test_a_file_that_may_not_grow(self):
        self.limited(4, "run", "--renderer=reference", "-o", self.out)

    def test_a_file_is_written_whole_or_stays_as_it_was(self):
        self.run_suite(check=0)
        self.run_suite("--renderer=tiles", out=self.folder / "tiles")
        place = self.folder / "place"
        place.mkdir()
        for name, words in {"a.json": ("render", "fam/c1", "-o"), "a.png": ("render", "fam/c1", "-o"), "a.exr": ("render", "fam/c1", "-o"),
                            "a.c": ("export", "--reproducer", "fam/c1", "-o"), "b.html": ("compare", self.out, self.folder / "tiles", "--html"),
                            "b.json": ("compare", self.out, self.folder / "tiles", "--json"),
                            "c.json": ("probe", "--renderer=flat-parts", "--json"),
                            "c.html": ("probe", "--renderer=flat-parts", "--html")}.items():
            file = place / name
            old = {".json": "{", ".html": "<!DOCTYPE html>"}.get(file.suffix, "") + "old"  # what an earlier report begins with
            file.write_text(old)
            file.chmod(0o640)
            self.limited(0, *words, file)
            self.assertEqual(file.read_text(), old, words)
            self.edgecase(*words, file, check=0)
            self.assertGreater(file.stat().st_size, len(old), words)
            self.assertEqual(file.stat().st_mode & 0o777, 0o640, words)
            self.assertEqual([f.name for f in place.iterdir()], [name], words)
            file.unlink()

    def test_reports_and_exports_are_written_whole_or_stay_as_they_were(self):
        self.run_suite(check=0)
        self.edgecase("export", "-o", "export", check=0)
        before = {f: f.read_bytes() for folder in (self.out, self.folder / "export") for f in folder.rglob("*") if f.is_file()}
        self.limited(0, "report", self.out, "--ci", "gitlab")
        self.limited(0, "export", "-o", "export")
        self.limited(0, "export", "-o", "fresh")
        after = {f: f.read_bytes() for folder in (self.out, self.folder / "export", self.folder / "fresh")
                 for f in folder.rglob("*") if f.is_file()}
        self.assertEqual(after, before)
        # The page is larger than the journal: what an earlier run left there is gone, and nothing half stands in its place.
        self.run_suite("--html", "page.html", check=0)
        self.limited(40, "run", "--renderer=reference", "-o", self.out, "--html", "page.html")
        self.assertFalse((self.folder / "page.html").exists())
        self.assertEqual({f.name for f in self.out.iterdir()}, {"journal.jsonl", "results.json", "junit.xml"})

    def test_reports_replace_links(self):
        self.run_suite(check=0)
        other = self.folder / "other.txt"
        other.write_text("mine")
        for name in ("results.json", "junit.xml", "report.html"):
            (self.out / name).unlink()
            (self.out / name).symlink_to(other)
        self.edgecase("report", self.out, check=0)
        self.assertEqual(other.read_text(), "mine")
        self.assertFalse((self.out / "results.json").is_symlink())
        self.assertEqual(list(self.out.glob("*.new")), [])

    def test_folder_that_cannot_be_made(self):
        (self.folder / "file").write_text("")
        done = self.run_suite(out=self.folder / "file" / "below", check=2)
        self.assertIn("-o", done.stderr)

    def test_json_on_standard_output(self):
        done = self.run_suite("--json", "-", check=0)
        self.assertEqual(len(json.loads(done.stdout)["cases"]), 10)

    def test_the_last_line_is_the_exit_code(self):
        done = self.run_suite("--json", "/dev/full", check=7)
        self.assertIn("exit 7: a report could not be written\n", done.stdout)
        done = self.edgecase("report", self.out, "-o", "/proc/x", check=7)
        self.assertNotIn("/proc/x", done.stdout)
        self.assertIn("exit 7: a report could not be written\n", done.stdout)
        done = self.edgecase("compare", self.out, self.out, "--html", "/dev/full", check=7)
        self.assertIn("exit 7: a file could not be written\n", done.stdout)
        self.run_suite(fault="flip-pixel@fam/c1", check=1)
        self.assertIn("the run ended with exit 1: unexpected results\n", self.edgecase("report", self.out, check=0).stdout)

    def test_standard_output_that_is_full(self):
        self.run_suite(check=0)
        for words in (("list", "--json"), ("explain", "fam/c1", "--pixel", "1,1"), ("version",), ("man",), ("lint",), ("doctor", "--renderer=tiles"),
                      ("run", "--help"), ("report", self.out), ("compare", self.out, self.out), ("explain", "--rule", "cover.inside")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *map(str, words)], env=self.environment(), cwd=self.folder, stdout=full,
                                      stderr=subprocess.PIPE, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 7, words)
            self.assertIn("edgecase: standard output cannot be written", done.stderr)

    def test_a_reader_that_has_read_enough(self):
        done = subprocess.run(["bash", "-c", '"$0" man | head -n 1; exit ${PIPESTATUS[0]}', PROGRAM], env=self.environment(), cwd=self.folder,
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.stderr, "")

    def test_closed_standard_streams(self):
        """A file that took the number of a closed stream would have what is said written into it."""
        for closed, code in ((">&-", 7), ("2>&-", 0), ("<&- >&-", 7), ("<&- 2>&-", 0), (">&- 2>&-", 7), ("<&- >&- 2>&-", 7)):
            out = self.folder / "closed"
            shutil.rmtree(out, ignore_errors=True)
            done = subprocess.run(["bash", "-c", f'"$@" {closed}', "bash", PROGRAM, "run", "--renderer=reference", "-o", out], cwd=self.folder,
                                  env=self.environment(), capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, code, closed)
            self.assertEqual(sorted(p.name for p in out.iterdir()), ["journal.jsonl", "junit.xml", "report.html", "results.json"], closed)
            self.assertIn("10 cases", self.edgecase("report", out, check=0).stdout)

    def test_report_rebuilds(self):
        self.run_suite(fault="segv@fam/c3", check=1)
        before = {name: (self.out / name).read_bytes() for name in ("results.json", "junit.xml", "report.html")}
        for name in before:
            (self.out / name).unlink()
        self.edgecase("report", self.out, check=0)
        self.assertEqual(before, {name: (self.out / name).read_bytes() for name in before})


class Debugger(ProgramTest):
    """The worker of one case on the terminal of the person who asked."""

    def test_it_keeps_the_terminal(self):
        script = self.folder / "debugger"
        script.write_text('#!/bin/sh\nread answer\necho "debugger hears $answer, starts $2"\nshift\nexec "$@"\n')
        script.chmod(0o755)
        done = self.edgecase("run", "--renderer=reference", "-o", self.out, "fam/c3", "--debugger", f"{script} -x",
                             stdin="hello\n", check=0)
        self.assertIn("debugger hears hello, starts /", done.stdout)
        self.assertEqual(self.statuses()["fam/c3"], "pass")
        self.assert_no_orphans()

    def test_a_crash_names_it(self):
        done = self.run_suite("fam/c3", fault="segv@fam/c3,noise@fam/c3", check=1)
        self.assertIn("      the driver printed:\n        | driver \\x1b[31mred", done.stdout)
        self.assertRegex(done.stdout, r"      debug: EDGECASE_FAULT=\S+ \S+ run fam/c3 .*--renderer reference --debugger gdb\n")
        done = self.run_suite("fam/c3", "--debugger", "env A=1", fault="segv@fam/c3", check=1)
        self.assertEqual(self.statuses()["fam/c3"], "crash")

    def test_an_interruption_is_the_debuggers(self):
        """Whoever works with it may take his time: the terminal's ctrl-c reaches both, and ends neither."""
        ready, go = self.folder / "ready", self.folder / "go"
        script = self.folder / "debugger"
        script.write_text(f"#!/bin/sh\ntrap 'echo broken in' INT\ntouch {ready}\nwhile [ ! -e {go} ]; do sleep 0.05; done\necho goes on\n")
        script.chmod(0o755)
        process = subprocess.Popen([PROGRAM, "run", "--renderer=reference", "-o", self.out, "fam/c3", "--debugger", f"{script} -x"],
                                   env=self.environment(), cwd=self.folder, stdout=subprocess.PIPE, start_new_session=True)
        while not ready.exists():
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(2)  # a command without a debugger has ended by then
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(0.2)
        go.touch()
        output, _ = process.communicate(timeout=60)
        self.assertIn(b"goes on", output)
        self.assertEqual(process.returncode, 130, output)

    def test_wrong_words(self):
        done = self.run_suite("--debugger", "gdb", check=2)
        self.assertEqual(done.stderr, "edgecase: --debugger runs one case, and 10 are selected; name one id\n")
        done = self.run_suite("fam/c3", "--debugger", "no-such-debugger", check=2)
        self.assertEqual(done.stderr, "edgecase: --debugger: there is no program 'no-such-debugger'; install it, or name "
                                      "another one\n")


class Order(ProgramTest):
    def test_settings_of_all_causes_are_told_once(self):
        env = self.environment(fault="flip-pixel,segv@fam/c2") | {"LP_NUM_THREADS": "1"}
        done = self.edgecase("run", "--renderer=reference", "-o", self.out, env=env, check=1)
        end = done.stdout[done.stdout.index("causes, the worst first"):done.stdout.index("smallest case: ")]
        self.assertRegex(end, r"^causes, the worst first; put the settings in front of each rerun:\n  settings: (\S+ )*LP_NUM_THREADS=1( \S+)*\n")
        self.assertEqual(end.count("LP_NUM_THREADS=1"), 1)
        self.assertEqual(len(re.findall(r"rerun: \S*edgecase run fam/c\d --suite \S+ --renderer reference\n", end)), 2)
        # In JSON a command is whole.
        for case in self.results()["cases"]:
            self.assertIn("LP_NUM_THREADS=1 ", case["rerun"])

    def test_two_runs_print_the_same(self):
        """Whatever the order in which two workers come to an end."""
        printed = []
        for fault in ("flip-pixel,segv@fam/c2", "flip-pixel,segv@fam/c2", "flip-pixel,segv@fam/c2"):
            done = self.run_suite("-j", "2", "--batch", "1", fault=fault, check=1)
            lines = [re.sub(r"after \S+ \w+|   \S+ m?s   seed", "", line) for line in done.stdout.splitlines()]
            printed.append(lines)
        self.assertEqual(printed[0], printed[1])
        self.assertEqual(printed[0], printed[2])
        text = "\n".join(printed[0])
        self.assertEqual(re.findall(r"^(?:FAIL|CRASH) (\S+)", text, re.M), ["fam/c2", "fam/c0"])
        # Settings of the machine's own driver, if there are any, stand above the causes.
        self.assertRegex(text, r"\nmore unexpected results: their causes follow; -v tells each\n\d+ cases .*\n"
                         r"causes, the worst first(:|; put the settings in front of each rerun:\n  settings: .*)\n"
                         r"  crash: SIGSEGV during submit in fam, 1 case   rerun: ")
        self.assertIn("\n  fail: cover.outside double in fam, 9 cases [vulkan]   rerun: ", text)


if __name__ == "__main__":
    unittest.main()
