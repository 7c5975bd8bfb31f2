# SPDX-License-Identifier: BSD-3-Clause
"""A rendered room as recordings of ROS 1 and ROS 2, written by programs that are not ours: rosbags and mcap."""
import decimal
import pathlib
import re
import struct
import zlib

import numpy as np


def unfiltered(kind, pixels, above):
    """One channel of a row by PNG's filter 3 (averages) or 4 (Paeth's); `above` has a zero more, to the left."""
    line, a, c = [], 0, 0
    for value, b in zip(pixels, above[1:]):
        if kind == 3:
            guess = (a + b) // 2
        else:
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - c - c)
            guess = a if pa <= pb and pa <= pc else b if pb <= pc else c
        a = (value + guess) & 255
        line.append(a)
        c = b
    return line


def read_png(path):
    """Of 8 bit RGB or 16 bit grey, as sslam writes them."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
        at += size + 12
    step = bits // 8 * (3 if colour == 2 else 1)
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * step)
    image = np.zeros((height + 1, width + 1, step), np.int32)  # with zeros above and to the left
    for y, row in enumerate(rows):
        pixels = row[1:].reshape(width, step).astype(np.int32)
        line, above = image[y + 1], image[y]
        if row[0] == 0:
            line[1:] = pixels
        elif row[0] == 1:
            line[1:] = np.cumsum(pixels, axis=0) & 255
        elif row[0] == 2:
            line[1:] = (pixels + above[1:]) & 255
        else:
            for channel in range(step):
                line[1:, channel] = unfiltered(row[0], pixels[:, channel].tolist(), above[:, channel].tolist())
    bytes_ = np.ascontiguousarray(image[1:, 1:].astype(np.uint8))
    return bytes_ if bits == 8 else bytes_.reshape(height, width, 2)[..., 0].astype(np.uint16) * 256 + bytes_[..., 1]


def nanoseconds(text):
    return int(decimal.Decimal(text).scaleb(9).to_integral_value())


class Room:
    """What `sslam synth` has written."""

    def __init__(self, folder, frames):
        self.folder = pathlib.Path(folder)
        self.images = self.listed("rgb.txt")[:frames]
        self.depths = self.listed("depth.txt")[:frames]
        self.truth = [(nanoseconds(row[0]), [float(v) for v in row[1:]]) for row in self.rows("groundtruth.txt")]
        text = (self.folder / "camera.yaml").read_text()
        self.camera = {key: float(value) for key, value in re.findall(r"Camera\.(\w+): ([-+.\de]+)", text)}

    def rows(self, name):
        return [line.split() for line in (self.folder / name).read_text().splitlines() if line[:1] != "#"]

    def listed(self, name):
        return [(nanoseconds(row[0]), self.folder / row[1]) for row in self.rows(name)]

    def messages(self, *, packed=False, depth="16UC1", camera=True, prefix="/camera"):
        """(topic, type, nanoseconds, fields), fields as in the definitions of ROS, arrays as numpy's."""
        frame = "optical"
        for (stamp, image), (_, depth_file) in zip(self.images, self.depths):
            header = {"stamp": stamp, "frame_id": frame}
            if packed:
                yield (f"{prefix}/image_raw/compressed", "sensor_msgs/msg/CompressedImage", stamp,
                       {"header": header, "format": "png", "data": np.frombuffer(image.read_bytes(), np.uint8)})
            else:
                pixels = read_png(image)
                yield (f"{prefix}/image_raw", "sensor_msgs/msg/Image", stamp, raw(header, pixels, "rgb8"))
            if camera:
                yield f"{prefix}/camera_info", "sensor_msgs/msg/CameraInfo", stamp, self.camera_info(header)
            if depth:
                pixels = np.round(1000 * (read_png(depth_file) / 5000)).astype(np.uint16)  # from sslam's factor
                if depth == "32FC1":  # the same depths, in metres
                    pixels = np.where(pixels == 0, np.nan, pixels / 1000).astype(np.float32)
                yield f"{prefix}/depth/image_raw", "sensor_msgs/msg/Image", stamp, raw(header, pixels, depth)
        for stamp, (x, y, z, qx, qy, qz, qw) in self.truth:
            yield ("/mocap/camera", "geometry_msgs/msg/TransformStamped", stamp,
                   {"header": {"stamp": stamp, "frame_id": "room"}, "child_frame_id": frame,
                    "transform": {"translation": {"x": x, "y": y, "z": z},
                                  "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}}})

    def camera_info(self, header):
        c = self.camera
        k = [c["fx"], 0, c["cx"], 0, c["fy"], c["cy"], 0, 0, 1]
        d = [c.get(name, 0) for name in ("k1", "k2", "p1", "p2", "k3")]
        return {"header": header, "height": int(c["height"]), "width": int(c["width"]), "distortion_model": "plumb_bob",
                "d": np.array(d, float), "k": np.array(k, float), "r": np.eye(3).ravel(),
                "p": np.array(k[:3] + [0] + k[3:6] + [0] + k[6:] + [0], float), "binning_x": 0, "binning_y": 0,
                "roi": {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}}


def raw(header, pixels, encoding):
    rows = np.ascontiguousarray(pixels)
    data = rows.view(np.uint8).ravel()
    return {"header": header, "height": rows.shape[0], "width": rows.shape[1], "encoding": encoding, "is_bigendian": 0,
            "step": data.size // rows.shape[0], "data": data}


def make(store, kind, value):
    """A message of rosbags' store from nested dictionaries."""
    if kind == "builtin_interfaces/msg/Time":
        return store.types[kind](sec=value // 10**9, nanosec=value % 10**9)
    made = dict(value)
    if kind == "std_msgs/msg/Header" and "seq" in {name for name, _ in store.fielddefs[kind][1]}:
        made["seq"] = 0
    for name, (form, detail) in store.fielddefs[kind][1]:
        field = name if name in made else name.lower()
        inner = made.pop(field)
        made[name] = make(store, detail, inner) if form.name == "NAME" else inner
    return store.types[kind](**made)


def write_ros1(path, messages, compression=None):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS1_NOETIC)
    writer = Writer(path)
    if compression:
        writer.set_compression(getattr(Writer.CompressionFormat, compression))
    with writer:
        connections = {}
        for topic, kind, stamp, fields in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=store)
            writer.write(connections[topic], stamp, store.serialize_ros1(make(store, kind, fields), kind))


def write_ros2(path, messages, plugin="MCAP", per_message=False):
    """A folder with metadata.yaml."""
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS2_HUMBLE)
    writer = Writer(path, version=9, storage_plugin=getattr(StoragePlugin, plugin))
    if per_message:
        writer.set_compression(CompressionMode.MESSAGE, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic, kind, stamp, fields in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=store)
            writer.write(connections[topic], stamp, store.serialize_cdr(make(store, kind, fields), kind))


def write_sqlite(path, messages, journal="DELETE"):
    """One .db3, by the tables that rosbag2's storage plugin documents. The open database."""
    import sqlite3
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS2_HUMBLE)
    database = sqlite3.connect(path)
    database.execute(f"PRAGMA journal_mode = {journal}")
    database.execute("PRAGMA wal_autocheckpoint = 0")
    database.execute("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)")
    database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                     "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
                     "data BLOB NOT NULL)")
    database.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
    topics = {}
    for topic, kind, stamp, fields in messages:
        if topic not in topics:
            topics[topic] = 7 + len(topics)
            database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (topics[topic], topic, kind))
        data = bytes(store.serialize_cdr(make(store, kind, fields), kind))
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", (topics[topic], stamp, data))
    database.commit()
    return database


def write_mcap(path, messages, compression="ZSTD", **options):
    """One file, by mcap and the definitions of rosbags."""
    from mcap.writer import CompressionType, Writer
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS2_HUMBLE)
    with open(path, "wb") as file:
        writer = Writer(file, compression=getattr(CompressionType, compression), **options)
        writer.start(profile="ros2")
        channels = {}
        for sequence, (topic, kind, stamp, fields) in enumerate(messages):
            if topic not in channels:
                definition = store.generate_msgdef(kind, ros_version=2)[0].encode()
                schema = writer.register_schema(name=kind, encoding="ros2msg", data=definition)
                channels[topic] = writer.register_channel(topic=topic, message_encoding="cdr", schema_id=schema)
            data = bytes(store.serialize_cdr(make(store, kind, fields), kind))
            writer.add_message(channels[topic], log_time=stamp, publish_time=stamp, data=data, sequence=sequence)
        writer.finish()
