#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam run --foxglove`: what Foxglove's own client gets, and what the server refuses.

Usage: foxglove.py PROGRAM PACKAGES CASE   (stream, refusals, limits, interrupted; PACKAGES: folder with node_modules)
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

from websocket_client import PROTOCOLS, Client

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "view"))
from served import PacedRun, listening  # noqa: E402
from view import call, make_room, refused, track  # noqa: E402

HERE = pathlib.Path(__file__).parent
KEPT = ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.sslam", "map.ply")


class StreamedRun(PacedRun):
    def __init__(self, program, *arguments, at="0"):
        super().__init__(program, *arguments, shown_by=("--foxglove", at))

    def rest(self):
        """Lets it track to the end; answers with the exit code."""
        for _ in self.progress:
            pass
        return self.process.wait()


def poses(path):
    """(nanoseconds, position, quaternion) of a trajectory, in ROS's world: x, z, -y."""
    rows = [[float(cell) for cell in line.split()] for line in path.read_text().splitlines() if line[:1] != "#"]
    half = 0.5**0.5
    for stamp, x, y, z, qx, qy, qz, qw in rows:
        # The product of that turn, (w, x) = (half, -half), with the quaternion.
        turned = (half * (qx - qw), half * (qy + qz), half * (qz - qy), half * (qw + qx))
        yield round(stamp * 1e9), (x, z, -y), turned


def near(a, b, most=1e-6):
    assert len(a) == len(b) and all(abs(p - q) < most for p, q in zip(a, b)), (a, b)


def same_pose(position, rotation, wanted_position, wanted_rotation):
    near([position[key] for key in "xyz"], wanted_position)
    found = [rotation[key] for key in "xyzw"]
    sign = 1 if sum(p * q for p, q in zip(found, wanted_rotation)) > 0 else -1
    near([sign * value for value in found], wanted_rotation)


def nanoseconds(stamp):
    return stamp["sec"] * 10**9 + stamp["nsec" if "nsec" in stamp else "nanosec"]


def check_stream(program, packages, scratch):
    room, plain, watched = make_room(program, scratch), scratch / "plain", scratch / "watched"
    # Something to warn of, in the midst and after the last frame.
    sorted((room / "rgb").iterdir())[30].write_bytes(b"no image")
    scale = "--scale", "known=1@30:50"
    recorded = scratch / "walk.mcap"
    call(program, *track(room, plain), *scale, "--quiet", "--record", recorded)
    call(program, "export", plain, "--format", "mcap")
    assert recorded.read_bytes() == (plain / "mcap" / "run.mcap").read_bytes()
    run = StreamedRun(program, *track(room, watched), *scale)
    clients = []
    for protocol in PROTOCOLS:
        client = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", "node", HERE / "client.mjs", packages, run.address, protocol],
                                  stdout=subprocess.PIPE, text=True)
        assert client.stdout.readline() == "ready\n"
        clients.append(client)
    # One that takes nothing, and one that has gone: they hold up nobody.
    idle = Client(run.port, f"/{run.token}", receive=4096)
    gone = Client(run.port, f"/{run.token}")
    for client in (idle, gone):
        client.send(json.dumps({"op": "subscribe", "subscriptions": [{"id": i, "channelId": i} for i in range(10)]}))
    gone.close()
    assert run.rest() == 0
    for name in KEPT:
        assert (plain / name).read_bytes() == (watched / name).read_bytes(), name
    call(program, "export", watched, "--format", "mcap")
    check_recording(packages, watched)
    for client, protocol in zip(clients, PROTOCOLS):
        answer, _ = client.communicate()
        assert client.returncode == 0
        compare(json.loads(answer), protocol, room, watched)


def compare(got, protocol, room, out):
    assert got["protocol"] == protocol and got["code"] == 1001 and got["info"]["name"].startswith("sslam "), got["info"]
    assert got["types"]["/tf"] == ["tf2_msgs/msg/TFMessage", "cdr", "ros2msg"] and len(got["types"]) == 10, got["types"]
    found = {}
    for entry in got["messages"]:
        found.setdefault(entry["topic"], []).append(entry)
    frames = {nanoseconds_of(line) for line in (room / "rgb.txt").read_text().splitlines() if line[:1] != "#"}
    # Each pose as it was told the moment its frame was tracked.
    live = list(poses(out / "trajectory_live.txt"))
    assert len(found["/tf"]) == len(live) > 40, (len(found["/tf"]), len(live))
    for entry, (stamp, position, rotation) in zip(found["/tf"], live):
        (transform,) = entry["message"]["transforms"]
        assert int(entry["time"]) == nanoseconds(transform["header"]["stamp"]) == stamp
        assert (transform["header"]["frame_id"], transform["child_frame_id"]) == ("map", "camera")
        same_pose(transform["transform"]["translation"], transform["transform"]["rotation"], position, rotation)
    # The path grows, and is that of the files in the end.
    sizes = [len(entry["message"]["poses"]) for entry in found["/path"]]
    final = list(poses(out / "trajectory.txt"))
    assert len(sizes) > 1 and sizes[-1] == len(final), sizes
    for entry, (stamp, position, rotation) in zip(found["/path"][-1]["message"]["poses"], final):
        assert nanoseconds(entry["header"]["stamp"]) == stamp
        same_pose(entry["pose"]["position"], entry["pose"]["orientation"], position, rotation)
    # So is the map: all but the stamps are those of the recording that is made of the files.
    metrics = json.loads((out / "metrics.json").read_text())
    assert found["/points"][-1]["message"]["width"] == metrics["points"] > 50
    assert len(found["/lines"][-1]["message"]["points"]) == 2 * metrics["lines"] > 20
    for topic, raw in exported(out / "mcap" / "run.mcap"):
        assert bytes.fromhex(found[topic][-1]["raw"])[12:] == raw[12:], topic
    (camera,) = found["/camera_info"]
    k = camera["message"]["k"]
    assert [k[0], k[4], k[2], k[5]] == metrics["settings"]["pinhole"], k
    assert [camera["message"]["width"], camera["message"]["height"]] == [320, 240]
    images = found["/image/compressed"]
    assert len(images) > 1 and all(entry["message"]["data"] == [320, 240] for entry in images), len(images)
    stamps = [nanoseconds(entry["message"]["header"]["stamp"]) for entry in images]
    assert stamps == sorted(set(stamps)) and set(stamps) <= frames
    # Of each frame since the client subscribed, which it may do while the first ones are tracked.
    rows, told = frame_rows(out), found["/diagnostics"]
    assert 40 < len(told) <= len(rows), (len(told), len(rows))
    for entry, row in zip(told, rows[-len(told):]):
        same_state(entry, row, ignored=("bridged",))  # which is known after the last frame
    logs = [entry["message"] for entry in found["/rosout"]]
    assert all(log["level"] == 30 for log in logs) and [log["msg"] for log in logs] == metrics["warnings"], logs
    assert len(logs) == 2 and "frame 30 has no pose" in logs[1]["msg"], logs


def frame_rows(out):
    with open(out / "frames.csv", newline="") as file:
        return list(csv.DictReader(file))


def same_state(entry, row, ignored=()):
    (status,) = entry["message"]["status"]
    assert int(entry["time"]) == nanoseconds(entry["message"]["header"]["stamp"]) == round(float(row["stamp"]) * 1e9)
    assert status["message"] == ": ".join(filter(None, (row["state"], row["reason"]))), (status, row)
    assert status["level"] == {"lost": 2, "initialising": 1, "uncertain": 1}.get(row["state"], 0), (status, row)
    told = {value["key"]: value["value"] for value in status["values"] if value["key"] not in ignored}
    assert told == {key: value for key, value in row.items() if key not in ("stamp", "state", "reason", *ignored)}, (told, row)


def check_recording(packages, out):
    """run.mcap by Foxglove's own reader: poses, and the state and the pictures of each frame."""
    done = subprocess.run(["node", HERE / "recording.mjs", packages, out / "mcap" / "run.mcap"], stdout=subprocess.PIPE, text=True, check=True)
    got, found = json.loads(done.stdout), {}
    for entry in got["messages"]:
        found.setdefault(entry["topic"], []).append(entry)
    assert int(got["count"]) == len(got["messages"]) and got["chunks"] > 0
    final = list(poses(out / "trajectory.txt"))
    assert len(found["/tf"]) == len(final) > 40
    for entry, (stamp, position, rotation) in zip(found["/tf"], final):
        (transform,) = entry["message"]["transforms"]
        assert int(entry["time"]) == stamp
        same_pose(transform["transform"]["translation"], transform["transform"]["rotation"], position, rotation)
    # Of each frame since the client subscribed, which it may do while the first ones are tracked.
    rows, told = frame_rows(out), found["/diagnostics"]
    assert 40 < len(told) <= len(rows), (len(told), len(rows))
    for entry, row in zip(told, rows[-len(told):]):
        same_state(entry, row)
    for topic in ("/image/compressed", "/overlay/compressed"):
        assert [entry["time"] for entry in found[topic]] == [entry["time"] for entry in found["/diagnostics"]], topic
        assert all(entry["message"]["data"] == [304, 228] for entry in found[topic]), topic
    assert "/normals/compressed" not in found and "/mesh" not in found


def nanoseconds_of(line):
    seconds, _, fraction = line.split()[0].partition(".")
    return int(seconds) * 10**9 + int(fraction.ljust(9, "0")[:9])


def exported(path):
    try:
        import mcap.reader
    except ImportError as missing:
        print(f"not compared with the export: {missing}")
        return
    with open(path, "rb") as file:
        for _, channel, message in mcap.reader.make_reader(file).iter_messages(topics=["/points", "/lines", "/planes"]):
            yield channel.topic, message.data


def check_refusals(program, packages, scratch):
    room, out = make_room(program, scratch), scratch / "out"
    refused(program, *track(room, out), "--quiet", "--record", scratch / "none" / "walk.mcap", words="walk.mcap: there is no folder ")
    with contextlib.closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        refused(program, *track(room, out), "--quiet", "--foxglove", port, words=f"--foxglove 127.0.0.1:{port}: is in use by another program")
    with contextlib.ExitStack() as usual:  # its port is taken, by this test or by somebody else
        with contextlib.suppress(OSError):
            usual.enter_context(socket.create_server(("127.0.0.1", 8765)))
        refused(program, *track(room, out), "--quiet", "--foxglove", words="--foxglove 127.0.0.1:8765: is in use by another program")
    refused(program, *track(room, out), "--quiet", "--foxglove", "192.0.2.1:0", words="is no address of this machine")
    for wrong in ("65536", "-1", "here", "localhost:8765", ":8765", "127.0.0.1:", "1.2.3.4:5:6"):
        refused(program, *track(room, out), f"--foxglove={wrong}", words="--foxglove: expected PORT or ADDRESS:PORT", code=2)
    refused(program, "run", "--foxglove", room, "--quiet", words="a dataset goes before --foxglove", code=2)
    (scratch / "old").mkdir()
    shutil.copy(room / "camera.yaml", scratch / "old")
    shutil.copytree(room / "rgb", scratch / "old" / "rgb")
    (scratch / "old" / "rgb.txt").write_text("".join(f"{i - 5} rgb/{path.name}\n" for i, path in enumerate(sorted((room / "rgb").iterdir()))))
    refused(program, *track(scratch / "old", out), "--quiet", "--foxglove", "0", words="--foxglove: the stamp -5")
    assert not (out / "frames.csv").exists()

    run = StreamedRun(program, *track(room, out))
    assert listening(run.port) == ["0100007F"]
    token = f"/{run.token}"
    for path in ("/", "/favicon.ico", f"/{'0' * 32}", token[:-1], f"{token}0", f"{token}/x", f"/x{token}", "/" + "y" * 3000):
        assert not Client(run.port, path).open, path
    for protocol in (None, "foxglove.websocket.v2", "http"):
        assert not Client(run.port, token, protocol).open, protocol
    assert run.ask(token)[0] == 404  # no page here
    client = Client(run.port, token, ", ".join(["unknown", *PROTOCOLS]))
    assert client.open and PROTOCOLS[0].encode() in client.head, client.head
    assert client.receive()["op"] == "serverInfo"
    channels = client.receive()["channels"]
    assert [channel["id"] for channel in channels] == list(range(10))
    for message, words in ((b"{", "no JSON object"), (b"[]", "no JSON object"), (b'{"op": 3}', "no JSON object"),
                           (b'{"op": "subscribe"}', "lacks the list subscriptions"),
                           (b'{"op": "subscribe", "subscriptions": [{"id": 1}]}', "an entry lacks channelId"),
                           (b'{"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 0}]}', "an id is no number"),
                           (b'{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 10}]}', "there is no channel 10"),
                           (b'{"op": "unsubscribe", "subscriptionIds": [7]}', "there is no subscription 7"),
                           (b"[" * 60000, "nested too deeply")):
        client.send(message.decode())
        status = client.receive()
        assert status["op"] == "status" and status["level"] == 2 and words in status["message"], (message, status)
    # What the server does not do is no fault of the client's.
    client.send('{"op": "getParameters", "parameterNames": [], "id": "1"}')
    client.send('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 0}]}')
    client.send('{"op": "subscribe", "subscriptions": [{"id": 2, "channelId": 0}]}')
    assert "channel 0 is subscribed to already" in client.receive()["message"]
    client.send('{"op": "unsubscribe", "subscriptionIds": [1]}')
    client.send('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]}')
    client.send('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 2}]}')
    assert "subscription 1 is there already" in client.receive()["message"]
    client.send("x" * 70000)
    assert client.receive() == (1009,)
    assert run.rest() == 0


def check_limits(program, packages, scratch):
    """More clients than are let in, silent ones and slow ones, hold up neither each other nor the run."""
    run = StreamedRun(program, *track(make_room(program, scratch), scratch / "out"))
    clients = [Client(run.port, f"/{run.token}") for _ in range(32)]
    assert all(client.open for client in clients)
    assert not Client(run.port, f"/{run.token}").open
    clients.pop().close()
    late = Client(run.port, f"/{run.token}")
    while not late.open:  # until the server has seen the other one go
        late = Client(run.port, f"/{run.token}")
    assert late.receive()["op"] == "serverInfo"
    assert run.rest() == 0


def check_interrupted(program, packages, scratch):
    run = StreamedRun(program, *track(make_room(program, scratch), scratch / "out"))
    client = Client(run.port, f"/{run.token}")
    client.send('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 0}]}')
    idle = Client(run.port, f"/{run.token}", receive=4096)
    for _ in range(5):
        run.event("frame")
    run.process.send_signal(signal.SIGINT)
    assert run.rest() == 130
    while (last := client.receive()) and last != (1001,):
        pass
    assert last == (1001,), last
    assert idle.open and (scratch / "out" / "trajectory.txt").exists()


CASES = {"stream": check_stream, "refusals": check_refusals, "limits": check_limits, "interrupted": check_interrupted}

if __name__ == "__main__":
    _, program, packages, case = sys.argv
    if case == "stream" and not (shutil.which("node") and pathlib.Path(packages, "node_modules", "@foxglove").is_dir()):
        print("SKIPPED: no node, or no npm packages in build-npm; scripts/install_packages --tests fetches them")
        sys.exit(0)
    with tempfile.TemporaryDirectory(prefix="sslam_foxglove_") as folder:
        CASES[case](program, packages, pathlib.Path(folder))
