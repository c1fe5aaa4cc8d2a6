# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Limits of processes, descriptors, address space and files: a command does its work, or says in one sentence which
limit keeps it from that; workers that die while they start, and signals."""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

from captures_support import INSIDE, png
from support import PROGRAM, ProgramTest

NOBODY = 65533  # limits of processes are for users other than root
WORDS = {  # of the sentence, by the limit
    resource.RLIMIT_NPROC: "the limit of processes (ulimit -u) is",
    resource.RLIMIT_NOFILE: "the limit of open files (ulimit -n) is",
    resource.RLIMIT_AS: "kB of address space (ulimit -v)",
}
PROXY = """import os, sys
# A worker whose bytes to its parent this passes on: {change}
worker_reads, to_worker = os.pipe()
from_worker, worker_writes = os.pipe()
if os.fork() == 0:
    os.dup2(worker_writes, 4)
    os.execv(sys.argv[1], sys.argv[1:])
os.close(worker_writes)
first = b""
while len(first) < 32 or len(first) < 32 + int.from_bytes(first[16:24], "little"):
    first += os.read(from_worker, 1)
os.write(4, {change})
while data := os.read(from_worker, 1 << 16):
    os.write(4, data)
"""


class Limited(ProgramTest):
    def setUp(self):
        super().setUp()
        # Somewhere that another user can read.
        self.program = self.folder / "bin" / "edgecase"
        self.program.parent.mkdir()
        shutil.copy(PROGRAM, self.program)
        module = pathlib.Path(PROGRAM).parent.parent / "lib" / "edgecase-image-io.so"
        self.module = self.folder / "edgecase-image-io.so"
        shutil.copy(module, self.module)
        self.folder.chmod(0o777)
        captures = self.folder / "captures" / self.ids[0]
        captures.mkdir(parents=True)
        (captures / "coverage.png").write_bytes(png(8, 8, [255 * inside for inside in INSIDE]))

    def limited(self, which, number, *words):
        """How a command ends under a limit, and what it says; it ends in any case."""
        def prepare():
            if which == resource.RLIMIT_NPROC and os.getuid() == 0:
                os.setresuid(NOBODY, NOBODY, NOBODY)
            resource.setrlimit(which, (number, number))
        env = self.environment() | {"EDGECASE_IMAGE_IO": str(self.module), "HOME": str(self.folder)}
        out = self.folder / f"out-{time.monotonic_ns()}"
        words = [str(w).replace("OUT", str(out)) for w in words]
        done = subprocess.run([self.program, *words], env=env, cwd=self.folder, capture_output=True, text=True, timeout=120,
                              check=False, preexec_fn=prepare)
        shutil.rmtree(out, ignore_errors=True)
        return done

    COMMANDS = (("run", "--renderer=reference", "-j", "2", "-o", "OUT"),
                ("diff", "--captures", "captures", "-o", "OUT"),
                ("render", "fam/c1", "-o", "OUT.exr"), ("render", "fam/c1", "-o", "OUT.json"),
                ("lint",), ("list",), ("explain", "fam/c1", "--pixel", "3,3"), ("export", "-o", "OUT"))

    def holds(self, which, numbers):
        outcomes = set()
        for number in numbers:
            for words in self.COMMANDS:
                done = self.limited(which, number, *words)
                said = done.stdout + done.stderr
                with self.subTest(number=number, words=words, rc=done.returncode, said=said):
                    self.assertIn(done.returncode, (0, 1, 3, 5, 7))
                    self.assertNotIn("terminate called", said)
                    self.assertNotIn("please report it", said)
                    if done.returncode != 0:
                        self.assertTrue(WORDS[which] in said or "Too many open files" in said
                                        or "error while loading shared libraries" in said, said)
                outcomes.add(done.returncode)
        self.assert_no_orphans()
        return outcomes

    def test_processes(self):
        self.assertEqual(self.holds(resource.RLIMIT_NPROC, (0, 2, 3, 4, 6, 12)), {0, 7})

    def test_descriptors(self):
        self.assertLessEqual({0, 7}, self.holds(resource.RLIMIT_NOFILE, (5, 7, 8, 10, 14, 18, 64)))

    def test_one_worker_draws_what_two_were_to_draw(self):
        for n in range(10, 300):
            self.write_case(f"fam/c{n}", (self.suite / "fam/c1.toml").read_text())
        done = self.limited(resource.RLIMIT_NPROC, 4, "run", "--renderer=reference", "-j", "2", "-o", "OUT")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("300 pass", done.stdout)

    def test_memory(self):
        # A case whose judgement needs more than the limit leaves; the program itself has some room.
        self.write_case("fam/c1", (self.suite / "fam/c1.toml").read_text().replace("[8, 8]", "[4096, 4096]"))
        for mebibytes in (300, 600):
            for words in (("render", "fam/c1", "-o", "OUT.json"), ("run", "--renderer=reference", "-o", "OUT"),
                          ("lint", "fam/c1")):
                done = self.limited(resource.RLIMIT_AS, mebibytes << 20, *words)
                said = done.stdout + done.stderr
                with self.subTest(mebibytes=mebibytes, words=words, rc=done.returncode, said=said):
                    self.assertIn(done.returncode, (0, 1, 3, 5, 7))
                    self.assertNotIn("terminate called", said)
                    if done.returncode != 0:
                        self.assertIn("(ulimit -v)", said)
        self.assert_no_orphans()


class Starting(ProgramTest):
    def run_with(self, prefix, *words, check):
        env = self.environment() | {"EDGECASE_SELF_PREFIX": str(prefix)}
        return self.edgecase("run", "--renderer=reference", "-j", "1", "-o", self.out, *words, env=env, check=check)

    def dying(self, times, how):
        count, prefix = self.folder / "count", self.folder / "prefix"
        prefix.write_text(f'n=$(($(cat {count} 2>/dev/null || echo 0) + 1)); echo $n >{count}\n'
                          f'[ $n -gt {times} ] || {how}\nexec "$@"\n')
        return f"/bin/sh {prefix}"

    def test_the_first_worker_is_started_again(self):
        done = self.run_with(self.dying(2, "kill -KILL $$"), check=0)
        self.assertEqual(done.stderr.count("the worker was killed by SIGKILL before it was ready; it is started again"), 2)
        self.assertEqual(set(self.statuses().values()), {"pass"})

    def test_deaths_that_differ_are_no_broken_driver(self):
        done = self.run_with(self.dying(4, "{ [ $n -eq 2 ] && kill -SEGV $$; kill -KILL $$; }"), check=0)
        self.assertEqual(done.stderr.count("it is started again"), 4)  # KILL, SEGV, KILL, KILL

    def test_three_deaths_alike_are_a_broken_driver(self):
        done = self.run_with(self.dying(1000, "kill -ABRT $$"), check=5)
        self.assertEqual(done.stderr.count("it is started again"), 2)
        self.assertIn("no device: the worker was killed by SIGABRT", done.stderr)

    def proxy(self, change):
        script = self.folder / "proxy.py"
        script.write_text(PROXY.replace("{change}", change))
        return f"{sys.executable} {script}"

    def test_a_right_proxy_changes_nothing(self):
        self.run_with(self.proxy("first"), check=0)

    def test_what_comes_behind_the_greeting_is_a_death(self):
        for change in ("first + first", "first + first[:7]", "first + b'warning: a stray write of a driver\\n'"):
            done = self.run_with(self.proxy(change), check=5)
            self.assertIn("the worker sent a result that is malformed before it was ready", done.stderr)
            self.assert_no_orphans()

    def test_an_announced_frame_of_sixty_gibibytes(self):
        done = self.run_with(self.proxy("first[:16] + (60 << 30).to_bytes(8, 'little') + first[24:]"), check=5)
        self.assertIn("malformed", done.stderr)


class Signals(ProgramTest):
    """Whatever a command does: a signal ends it within a second, which the test does not measure."""

    def ends(self, number, *words, ready=None):
        process = subprocess.Popen([PROGRAM, *map(str, words)], env=self.environment(), cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        while ready is not None and not ready() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(number)
        output, _ = process.communicate(timeout=60)
        self.assertIn(process.returncode, (130, -number), output)
        self.assert_no_orphans()
        return output.decode()

    def large(self):
        """A file of one's own whose claims alone are looked at for minutes."""
        corners = ",\n".join(f"[{x}.25, 0.5, 0.5, {1 + x % 7}], [{x + 900}.75, 3000, 0.25, {2 + x % 5}], [{x}, 4096, 0.75, {1 + x % 3}]"
                             for x in range(0, 3000, 2))
        values = ",\n".join(f"[{k % 13}]" for k in range(4500))
        file = self.folder / "large.toml"
        file.write_text(f"""format = 1
description = "Many large triangles."
rules = ["cover.inside"]
[target]
size = [4096, 4096]
[[draw]]
vertices = [{corners}]
[[draw.attribute]]
values = [{values}]
""")
        return file

    def test_commands_that_only_compute(self):
        large = self.large()
        for words in (("run", large, "--renderer=reference", "-o", self.out), ("lint", large), ("render", large, "-o", "a.json"),
                      ("lint", "--strength", large)):
            for number in (signal.SIGINT, signal.SIGTERM) if words[0] == "run" else (signal.SIGHUP,):
                begin = time.monotonic()
                self.ends(number, *words, ready=lambda: time.monotonic() > begin + 0.5)
        self.assertFalse((self.folder / "a.json").exists())

    def test_a_hangup_that_nohup_ignores(self):
        def ignore():
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
        env = self.environment("hang@fam/c8")
        process = subprocess.Popen([PROGRAM, "run", "--renderer=reference", "--timeout", "2", "-o", self.out], env=env,
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=ignore)
        journal = self.out / "journal.jsonl"
        while not (journal.exists() and '"begin"' in journal.read_text()):
            time.sleep(0.01)
        process.send_signal(signal.SIGHUP)
        output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, output)
        self.assertEqual(self.statuses()["fam/c8"], "timeout")


class Grandchildren(ProgramTest):
    def test_a_driver_that_leaves_a_child_behind(self):
        """Its constructor forks a process that holds every descriptor for minutes."""
        manifest = self.folder / "icd.json"
        manifest.write_text(json.dumps({"file_format_version": "1.0.0", "ICD": {
            "library_path": os.environ["EDGECASE_LEAVING_CHILD"], "api_version": "1.3.0"}}))
        done = self.edgecase("doctor", "--icd", manifest, "--timeout", "3", check=5)
        self.assertIn("problem", done.stdout)
        self.assert_no_orphans()


if __name__ == "__main__":
    unittest.main()
