# SPDX-License-Identifier: BSD-3-Clause
"""What `sslam export --format mcap` writes, read back by other programs: the case `export` of bag.py."""
import csv

import mcap.reader
import mcap_ros2.decoder
import numpy as np


def check(sslam):
    sslam.run(sslam.room.folder, "run")
    out = sslam.scratch / "run"
    sslam.run_program("export", out, "--format", "mcap")
    trajectory = np.loadtxt(out / "trajectory.txt")
    vertices = [line.split() for line in (out / "map.ply").read_text().splitlines()]
    count = {row[1]: int(row[2]) for row in vertices if row[0] == "element"}
    vertices = np.array(vertices[vertices.index(["end_header"]) + 1:][:count["vertex"]], float)
    found = {}
    with open(out / "mcap" / "run.mcap", "rb") as file:
        reader = mcap.reader.make_reader(file, validate_crcs=True, decoder_factories=[mcap_ros2.decoder.DecoderFactory()])
        summary = reader.get_summary()
        for schema, channel, message, ros in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append((schema.name, message.log_time, ros))
    assert summary.statistics.message_count == sum(map(len, found.values()))
    assert len(summary.chunk_indexes) == summary.statistics.chunk_count > 0
    check_types(out / "mcap" / "run.mcap")

    turn = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float)  # x, z, -y
    tf = found["/tf"]
    assert len(tf) == len(trajectory)
    (path,) = [ros for _, _, ros in found["/path"]]
    assert len(path.poses) == len(trajectory)
    for row, (name, time, ros), pose in zip(trajectory, tf, path.poses):
        (transform,) = ros.transforms
        assert name == "tf2_msgs/msg/TFMessage" and (transform.header.frame_id, transform.child_frame_id) == ("map", "camera")
        assert time == transform.header.stamp.sec * 10**9 + transform.header.stamp.nanosec == round(row[0] * 1e9)
        t, q = transform.transform.translation, transform.transform.rotation
        assert np.allclose([t.x, t.y, t.z], turn @ row[1:4], atol=1e-6)
        assert np.allclose(matrix(q.x, q.y, q.z, q.w), turn @ matrix(*row[4:8]), atol=1e-6)
        assert (pose.pose.position.x, pose.pose.orientation.w) == (t.x, q.w)
    (cloud,) = [ros for _, _, ros in found["/points"]]
    points = vertices[:cloud.width]
    cells = np.frombuffer(bytes(cloud.data), np.dtype("<f4, <f4, <f4, 3u1, u1"))
    assert len(cells) == cloud.width > 20 and cloud.row_step == len(cloud.data)
    for cell, point in zip(cells, points):
        assert np.allclose([cell[0], cell[1], cell[2]], turn @ point[:3], atol=1e-4)
        assert cell[3].tolist() == point[:2:-1].tolist()  # blue, green, red
    (lines,) = [ros for _, _, ros in found["/lines"]]
    ends = vertices[cloud.width:][:2 * count["edge"]]
    assert len(lines.points) == len(lines.colors) == len(ends) > 10
    for end, colour, row in zip(lines.points, lines.colors, ends):
        assert np.allclose([end.x, end.y, end.z], turn @ row[:3], atol=1e-5)
        assert np.allclose([colour.r, colour.g, colour.b, colour.a], [*row[3:] / 255, 1], atol=1e-3)
    (camera,) = [ros for _, _, ros in found["/camera_info"]]
    assert (camera.width, camera.height) == (320, 240) and camera.k[0] == camera.p[0] == sslam.room.camera["fx"]
    states = [ros.status[0] for _, _, ros in found["/diagnostics"]]
    with open(out / "frames.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [state.message.split(":")[0] for state in states] == [row["state"] for row in rows]
    assert {value.key: value.value for value in states[-1].values}["point_inliers"] == rows[-1]["point_inliers"]
    # What was exported is a recording without images, since this run kept none.
    assert "holds no images" in sslam.run(out / "mcap" / "run.mcap", "again", code=1)[1]


def check_types(path):
    """The definitions in the file are those of ROS 2, field by field."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    known = get_typestore(Stores.ROS2_HUMBLE).fielddefs
    with open(path, "rb") as file:
        for schema in mcap.reader.make_reader(file).get_summary().schemas.values():
            for name, (_, fields) in get_types_from_msg(schema.data.decode(), schema.name).items():
                assert fields == known[name][1], name


def matrix(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
