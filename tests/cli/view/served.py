#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The program under test as a server, and questions to it as bytes on the wire.

Usage: served.py PROGRAM run DATASET... --view --json-progress

Runs a command that shows its run live, and lets it track as far as it is told: prints the page's address, then answers each
line of standard input: "step" with the next frame's number, "finish" with "over" once the run is.
"""
import json
import pathlib
import re
import signal
import socket
import subprocess
import sys
import urllib.parse

ADDRESS = r"(?:http|ws)://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/?"


class Served:
    """`sslam view`, or a run with --view whose progress is JSON."""

    def __init__(self, program, *arguments, stderr=subprocess.PIPE):
        self.process = subprocess.Popen([program, *map(str, arguments)], stdout=subprocess.PIPE, stderr=stderr, text=True)

    def find_address(self, line):
        found = re.search(ADDRESS, line)
        assert found, (line, self.process.communicate() if not line else "")
        self.address, self.port, self.token = found.group(), int(found.group(1)), found.group(2)

    def ask(self, path=None, method="GET", host=None, extra="", body=""):
        """Answers with status, head and body; host "": no such header. path: of the token's folder, or whole with a /."""
        path = path if path is not None and path.startswith(("/", "http")) else f"/{self.token}/{path or ''}"
        host = f"127.0.0.1:{self.port}" if host is None else host
        head = f"{method} {path} HTTP/1.1\r\n" + (f"Host: {host}\r\n" if host else "") + extra
        with socket.create_connection(("127.0.0.1", self.port)) as connection:
            connection.sendall(f"{head}\r\n{body}".encode())
            answer = b"".join(iter(lambda: connection.recv(1 << 16), b""))
        head, _, body = answer.partition(b"\r\n\r\n")
        return int(head.split()[1]), head.decode(), body

    def data(self):
        """What the page is given."""
        status, _, page = self.ask()
        assert status == 200, status
        return json.loads(page.split(b'<script id="data" type="application/json">')[1].split(b"</script>")[0])

    def end(self, number=signal.SIGINT):
        """Answers with exit code, standard output and standard error."""
        self.process.send_signal(number)
        out, err = self.process.communicate()
        return self.process.returncode, out, err


def listening(port):
    """The addresses, in the system's hexadecimal, on which somebody listens to the port."""
    lines = [line.split() for kind in ("tcp", "tcp6") for line in pathlib.Path(f"/proc/net/{kind}").read_text().splitlines()[1:]]
    places = [line[1].split(":") for line in lines if line[3] == "0A"]
    return [address for address, number in places if int(number, 16) == port]


class View(Served):
    def __init__(self, program, *arguments):
        super().__init__(program, "view", *arguments)
        self.find_address(self.process.stdout.readline())


class PacedRun(Served):
    """Tracks no further than its progress is read, since the way of its progress holds a few lines only."""

    def __init__(self, program, *arguments, shown_by=("--view",)):
        reading, writing = socket.socketpair()
        writing.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1)
        super().__init__(program, *arguments, *shown_by, "--json-progress", stderr=writing)
        writing.close()
        self.progress = reading.makefile("rb", buffering=0)  # else Python would read ahead
        reading.close()
        self.find_address(self.event("note")["text"])

    def event(self, *kinds):
        """The next one of these kinds; None at the end of all progress."""
        for line in self.progress:
            event = json.loads(line)
            if event["event"] in kinds:
                return event
        return None

    def news(self, version):
        status, _, body = self.ask("news?" + urllib.parse.urlencode({"version": version}))
        assert status in (200, 204), status
        return json.loads(body) if status == 200 else None

    def finish(self):
        """Lets it track the rest; answers with the line that says it is over."""
        while True:
            event = self.event("note", "error")
            assert event, "ended before it was over"
            if event["event"] == "note" and "the run is over" in event["text"]:
                return event["text"]


def main():
    run = PacedRun(*sys.argv[1:])
    print(run.address, flush=True)
    for line in sys.stdin:
        if line == "step\n":
            print(run.event("frame")["done"], flush=True)
        if line == "finish\n":
            run.finish()
            print("over", flush=True)
    run.process.send_signal(signal.SIGINT)
    run.progress.close()  # else it would wait for its progress to be read
    run.process.communicate()


if __name__ == "__main__":
    main()
