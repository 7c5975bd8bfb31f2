#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam view` and `sslam run --view` over the wire. look.mjs opens their pages in a browser.

Usage: view.py PROGRAM CASE   (saved, refusals, input, live, interrupted)
"""
import contextlib
import csv
import json
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading

from served import PacedRun, View, listening

FRAMES = 60


def call(program, *arguments, code=0):
    # A command that should have ended and serves instead ends with this test, not after it.
    done = subprocess.run(["setpriv", "--pdeathsig", "KILL", program, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done)
    return done


def make_room(program, scratch):
    room = scratch / "room"
    call(program, "synth", room, "--quiet", "--frames", FRAMES, "--seed", 3, "--size", "320x240")
    return room


def track(room, out):
    return "run", room, "--normals", "none", "--out", out


def refused(program, *arguments, words, code=1):
    done = call(program, *arguments, code=code)
    assert done.stdout == "" and done.stderr.count("\n") == 1, done
    assert done.stderr.startswith("sslam: error: ") and words in done.stderr, (words, done.stderr)


def check_saved(program, scratch):
    room, run = make_room(program, scratch), scratch / "run"
    call(program, *track(room, run), "--dense", "--quiet")
    view = View(program, run)
    status, head, page = view.ask()
    assert status == 200 and "text/html" in head and "no-store" in head, head
    assert page == (run / "report.html").read_bytes()
    assert view.ask(extra="Accept-Encoding: gzip, br\r\n")[2] == page
    assert view.ask(host=f"localhost:{view.port}")[0] == 200
    assert view.ask(f"/{view.token}")[:1] == (302,)
    assert view.ask("news?version=0")[0] == 404  # a run that is over has none
    assert view.end() == (0, "", "")

    view = View(program, run / "map.sslam")
    data, figures = view.data(), json.loads((run / "metrics.json").read_text())
    assert data["kind"] == "map" and data["folder"] == "map.sslam"
    assert data["metrics"] == {name: figures[name] for name in ("keyframes", "points", "lines", "planes")}, data["metrics"]
    surfaces = data["surfaces"]
    assert len(surfaces["jpeg"]) > 1000, surfaces.keys()
    assert view.end(signal.SIGTERM) == (0, "", "")
    # A map and its model alone; then a model that has lost its end.
    alone = scratch / "alone"
    alone.mkdir()
    for name in ("map.sslam", "model.glb"):
        shutil.copy(run / name, alone)
    view = View(program, alone / "map.sslam")
    assert view.data()["surfaces"] == surfaces
    assert view.end() == (0, "", "")
    (alone / "model.glb").write_bytes((run / "model.glb").read_bytes()[:5000])
    view = View(program, alone / "map.sslam")
    assert "surfaces" not in view.data()
    code, _, err = view.end()
    assert code == 0 and err.count("\n") == 1 and "model.glb: ends too early: no surfaces are shown" in err, err

    # Half of it is gone.
    (run / "map.sslam").unlink()
    (run / "frames.csv").write_bytes((run / "frames.csv").read_bytes()[:3000])
    view = View(program, run)
    problems = view.data()["problems"]
    assert any("map.sslam: is missing" in problem for problem in problems), problems
    code, _, err = view.end()
    assert code == 0 and "sslam: warning: " in err and "map.sslam: is missing" in err, err

    # No frame was tracked.
    call(program, *track(room, scratch / "none"), "--end", 2, "--quiet", code=1)
    view = View(program, scratch / "none")
    assert view.data()["metrics"]["tracked"] == 0
    assert view.end()[0] == 0


def check_refusals(program, scratch):
    (scratch / "metrics.json").write_text("{}")
    (scratch / "secret.txt").write_text("secret")
    with contextlib.closing(socket.socket()) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    view = View(program, scratch, "--port", port)
    assert view.port == port
    other = View(program, scratch)
    assert other.token != view.token
    for path in ("/", "/favicon.ico", f"/{other.token}/", f"/{view.token[:-1]}/", f"/{view.token}0/", "/../secret.txt", "//", "/%00"):
        assert view.ask(path)[0] == 403, path
    for path in ("secret.txt", "metrics.json", "../secret.txt", "../../../../../../etc/passwd", "%2e%2e/secret.txt", "..%2fsecret.txt",
                 "/etc/passwd", "page", "news", "x" * 4000, "%00"):
        status, _, body = view.ask(f"/{view.token}/{path}")
        assert status == 404 and b"secret" not in body and b"root:" not in body, (path, status)
    assert view.ask("y" * 100000)[0] == 414
    for host in ("", "127.0.0.1", "localhost", f"evil.example:{port}", f"127.0.0.1:{other.port}", f"127.0.0.1:{port}.evil.example",
                 f"[::1]:{port}", f"localhost:{port}\r\nHost: evil.example"):
        status, _, body = view.ask(host=host)
        assert status == 403 and b"<html" not in body, (host, status)
    for method in ("POST", "PUT", "DELETE", "PATCH", "HEAD", "OPTIONS"):
        status, head, _ = view.ask(method=method)
        assert status == 405 and "Allow: GET" in head, (method, head)
    assert view.ask(method="POST", extra="Content-Length: 5\r\n", body="hello")[0] == 405
    assert view.ask(method="BREW")[0] in (400, 405)
    assert listening(port) == ["0100007F"]
    # Those who say nothing, or half a word, keep nobody out.
    with contextlib.ExitStack() as silent:
        for i in range(6):
            connection = silent.enter_context(socket.create_connection(("127.0.0.1", port)))
            connection.sendall(b"GET /" if i % 2 else b"")
        assert view.ask()[0] == 200
    # Nor do more than there are workers, who go on to say a letter now and then; and none of them holds up the end.
    with slow_clients(port, 48):
        assert view.ask()[0] == 200
        assert view.end()[0] == 0
    assert other.end()[0] == 0


@contextlib.contextmanager
def slow_clients(port, count):
    """Each sends a byte of a request that has no end every tenth of a second, as long as somebody listens."""
    over = threading.Event()

    def drip(connections):
        while not over.wait(0.1):
            for connection in connections:
                with contextlib.suppress(OSError):
                    connection.send(b"a")

    with contextlib.ExitStack() as stack:
        connections = [stack.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(count)]
        for connection in connections:
            connection.sendall(b"GET /")
        thread = threading.Thread(target=drip, args=(connections,))
        thread.start()
        try:
            yield
        finally:
            over.set()
            thread.join()


def check_input(program, scratch):
    refused(program, "view", scratch / "none", words="none: no such file or folder; expected the folder of a run or a map.sslam")
    refused(program, "view", scratch, words="holds no run that can be read")
    (scratch / "report.html").write_text("<html>")
    refused(program, "view", scratch / "report.html", words="report.html: is no map; expected a map.sslam")
    refused(program, "view", words="path is required", code=2)
    refused(program, "view", scratch, "--port", 65536, words="--port", code=2)
    refused(program, "run", scratch, "--port", 8080, words="--port requires --view", code=2)
    (scratch / "metrics.json").write_text('{"keyframes": 0, "tracked": 0}')
    (scratch / "frames.csv").write_text("index,stamp\n")
    room = make_room(program, scratch)
    with contextlib.closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        words = f"--port {port}: is in use by another program; choose another, or 0 for any free one"
        refused(program, "view", scratch, "--port", port, words=words)
        refused(program, *track(room, scratch / "out"), "--quiet", "--view", "--port", port, words=words)
    assert not (scratch / "out/frames.csv").exists()
    view = View(program, scratch)
    refused(program, "view", scratch, "--port", view.port, words="is in use by another program")
    assert view.end()[0] == 0


def frames_without_times(path):
    with open(path, newline="") as file:
        return [{name: cell for name, cell in row.items() if not name.endswith("_ms")} for row in csv.DictReader(file)]


def check_live(program, scratch):
    room, plain, watched = make_room(program, scratch), scratch / "plain", scratch / "watched"
    call(program, *track(room, plain), "--quiet")
    run = PacedRun(program, *track(room, watched))
    data = run.data()
    assert data["kind"] == "live" and data["total"] == FRAMES, data["kind"]
    assert data["metrics"]["settings"]["preset"] == "structure"
    version, counts, tracked = data["version"], [data["frames"]["count"]], []
    while counts[-1] < 40:
        news = run.news(version)
        if news is None:
            assert run.event("frame"), counts
            continue
        assert not news["over"] and news["view"]
        version = news["data"]["version"]
        counts.append(news["data"]["frames"]["count"])
        tracked.append(news["data"]["metrics"]["tracked"])
    assert len(counts) > 2 and counts == sorted(set(counts)), counts
    assert tracked == sorted(tracked) and tracked[-1] > 20, tracked
    assert news["data"]["metrics"]["points"] > 100 and news["data"]["metrics"]["keyframes"] > 1
    assert run.address in run.finish()
    assert run.news(version) == {"over": True}
    assert run.ask()[2] == (watched / "report.html").read_bytes()
    code, out, _ = run.end()
    assert code == 0 and out.startswith("tracked "), (code, out)
    for name in ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.sslam", "map.ply", "views.bin"):
        assert (plain / name).read_bytes() == (watched / name).read_bytes(), name
    assert frames_without_times(plain / "frames.csv") == frames_without_times(watched / "frames.csv")


def check_interrupted(program, scratch):
    room, out = make_room(program, scratch), scratch / "out"
    run = PacedRun(program, *track(room, out))
    for _ in range(5):
        run.event("frame")
    run.process.send_signal(signal.SIGINT)
    warning = run.event("warning")
    while "interrupted" not in warning["text"]:
        warning = run.event("warning")
    assert run.process.wait() == 130
    assert json.loads((out / "metrics.json").read_text())["interrupted"] and (out / "report.html").exists()

    # Nothing to see is said, and shown, before the code tells it.
    run = PacedRun(program, *track(room, scratch / "none"), "--end", 2)
    assert "no frame was tracked" in run.event("error")["text"]
    run.finish()
    assert run.data()["metrics"]["tracked"] == 0
    assert run.end()[0] == 1


def main():
    program, case = sys.argv[1:]
    with tempfile.TemporaryDirectory() as scratch:
        globals()[f"check_{case}"](program, pathlib.Path(scratch))


if __name__ == "__main__":
    main()
