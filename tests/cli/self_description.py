#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is made from the program's own options: man page and completions, as they are and where they are installed.

Usage: self_description.py PROGRAM BUILD_FOLDER WHAT

WHAT: options (each of them is everywhere), man (groff finds no fault), bash or zsh (a person presses the tab key),
install (from the build and from the Debian package). Ends with 77, which stands for skipped, where a tool is missing.
"""
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
SETUP = {
    "bash": ("bash --norc --noprofile -i", "source {pages}/sslam"),
    "zsh": ("zsh -f -i", "fpath=({pages} $fpath); autoload -U compinit; compinit -u -D; unsetopt zle_bracketed_paste"),
}
# What is typed, and what the shell makes of it.
KEYS = [
    ("sslam expo\t --format k\t", "export --format kitti"),
    ("sslam run --pre\tstru\t", "run --preset structure"),
    ("sslam run --json\t", "run --json-progress"),
    ("sslam run --config cam\t", "run --config camera.toml"),
    ("sslam run --out walk\t", "run --out walks"),  # no file
    ("sslam report walks\t", "report walks"),
    ("sslam --comp\tba\t", "--completion bash"),
]


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def check_options(program, _):
    man = output(program, "--man").replace("\\-", "-")
    bash, zsh = (output(program, "--completion", shell) for shell in ("bash", "zsh"))
    commands = re.findall(r"^  (\w+)  ", output(program, "--help").split("Subcommands:")[1], re.M)
    assert len(commands) >= 7, commands
    for command in commands:
        flags = re.findall(r"^  (?:-\w,)?(--[\w-]+)", output(program, command, "--help"), re.M)
        assert "--help" in flags, (command, flags)
        section = re.search(rf"^\.SS \\&{command}\n.*?(?=^\.S[SH] )", man, re.M | re.S).group()
        in_bash = re.search(rf"^    {command}\)$.*?^      ;;$", bash, re.M | re.S).group()
        in_zsh = re.search(rf"^    {command}\)$.*?^      ;;$", zsh, re.M | re.S).group()
        for flag in flags:
            assert f"\\&{flag}\\fR" in section, ("man", command, flag)
            assert re.search(rf"[ ']{flag}[ ']", in_bash), ("bash", command, flag)
            assert f"{flag}[" in in_zsh, ("zsh", command, flag)
    for code in ("0", "1", "2", "130"):
        assert f".TP\n\\fB\\&{code}\\fR\n" in man, code


def check_man(program, _):
    if not shutil.which("groff"):
        return SKIPPED
    page = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=output(program, "--man"), text=True,
                          capture_output=True, check=True)
    assert not page.stderr, page.stderr
    text = re.sub(r"\x1b\[\d*m|.\x08", "", page.stdout)
    for words in ("sslam - Low-drift", "--preset WORD", "130", "interrupted"):
        assert words in text, words


class Shell:
    """On a terminal of its own."""

    def __init__(self, command, folder):
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.environ.update(TERM="dumb", HOME=str(folder), INPUTRC="/dev/null")
            os.execvp("sh", ["sh", "-c", f"exec {command}"])
        self.seen = ""

    def type(self, keys):
        os.write(self.terminal, keys.encode())

    def wait_for(self, words):
        """Answers with what came before them. However slow the machine is: they come, or the shell ends."""
        while words not in self.seen:
            try:
                read = os.read(self.terminal, 4096)
            except OSError:  # Linux: nobody holds the other side any more
                read = b""
            assert read, f"the shell ended without {words!r} in {self.seen!r}"
            self.seen += read.decode(errors="replace")
        before, self.seen = self.seen.split(words, 1)
        return before

    def close(self):
        os.close(self.terminal)
        os.waitpid(self.child, 0)


def check_shell(name, program):
    if not shutil.which(name):
        return SKIPPED
    with tempfile.TemporaryDirectory() as scratch:
        pages = pathlib.Path(scratch) / "pages"
        folder = pathlib.Path(scratch) / "home"
        for made in (pages, folder, folder / "walks"):
            made.mkdir()
        for name_of_file in ("camera.toml", "walk.txt"):
            (folder / name_of_file).touch()
        (pages / "sslam").write_text(output(program, "--completion", "bash"))
        (pages / "_sslam").write_text(output(program, "--completion", "zsh"))
        command, setup = SETUP[name]
        shell = Shell(command, folder)
        # The marks are typed in two parts, so that their echo is no mark.
        shell.type(setup.format(pages=pages) + "\n")
        shell.type("sslam() { echo 'GO''T' \"$@\" 'EN''D'; }; PS1='REA''DY> '; unset PROMPT_COMMAND\n")
        for keys, wanted in KEYS:
            shell.wait_for("READY> ")
            shell.type(keys + "\n")
            shell.wait_for("GOT ")
            got = shell.wait_for(" END").rstrip("/")  # which zsh takes away
            assert got == wanted, (keys, got, wanted)
        shell.close()


def check_install(program, build):
    pages = {"share/man/man1/sslam.1": ("--man",), "share/bash-completion/completions/sslam": ("--completion", "bash")}
    zsh = output(program, "--completion", "zsh")
    with tempfile.TemporaryDirectory() as scratch:
        prefix = pathlib.Path(scratch) / "prefix"
        output("cmake", "--install", build, "--prefix", prefix, "--component", "cli")
        for page, options in pages.items():
            assert (prefix / page).read_text() == output(program, *options), page
        assert (prefix / "share/zsh/site-functions/_sslam").read_text() == zsh
        if not all(shutil.which(tool) for tool in ("dpkg-deb", "dpkg-shlibdeps", "file")):  # which cpack asks
            return SKIPPED
        output("cpack", "--config", f"{build}/CPackConfig.cmake", "-G", "DEB", "-B", scratch,
               "-D", "CPACK_COMPONENTS_ALL=cli")
        package, = pathlib.Path(scratch).glob("sslam_*.deb")
        output("dpkg-deb", "--extract", package, f"{scratch}/root")
        usr = pathlib.Path(scratch) / "root/usr"
        for page, options in pages.items():
            assert (usr / page).read_text() == output(program, *options), page
        assert (usr / "share/zsh/vendor-completions/_sslam").read_text() == zsh


def main():
    program, build, what = sys.argv[1:]
    checks = {"options": check_options, "man": check_man, "install": check_install}
    if what in SETUP:
        return check_shell(what, program)
    return checks[what](program, build)


if __name__ == "__main__":
    sys.exit(main())
