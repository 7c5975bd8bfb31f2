# SPDX-License-Identifier: BSD-3-Clause
"""A client of Foxglove's protocol in bytes, for what no sound one does."""
import base64
import contextlib
import json
import os
import socket
import struct

PROTOCOLS = ("foxglove.sdk.v1", "foxglove.websocket.v1")


class Client:
    """A WebSocket in bytes, for what no sound client does."""

    def __init__(self, port, path, protocol=PROTOCOLS[0], receive=None):
        self.socket = socket.socket()
        if receive:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive)
        self.socket.connect(("127.0.0.1", port))
        lines = [f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}", "Sec-WebSocket-Version: 13"]
        if protocol:
            lines.append(f"Sec-WebSocket-Protocol: {protocol}")
        self.socket.sendall("\r\n".join([*lines, "", ""]).encode())
        self.stream = self.socket.makefile("rb")
        self.head = b""
        with contextlib.suppress(ConnectionError):
            while not self.head.endswith(b"\r\n\r\n") and (line := self.stream.readline()):
                self.head += line
        self.open = self.head.startswith(b"HTTP/1.1 101")

    def close(self):
        self.stream.close()
        self.socket.close()

    def send(self, text, opcode=1):
        data = text.encode()
        size = struct.pack("!BB", 0x80 | opcode, 0x80 | len(data)) if len(data) < 126 else struct.pack("!BBQ", 0x80 | opcode, 0xFF, len(data))
        self.socket.sendall(size + bytes(4) + data)  # a mask of zeros

    def receive(self):
        """The next text as JSON, (code,) of a goodbye, None at the end; others are passed over."""
        while head := self.stream.read(2):
            size = head[1] & 127
            if size == 126:
                (size,) = struct.unpack("!H", self.stream.read(2))
            elif size == 127:
                (size,) = struct.unpack("!Q", self.stream.read(8))
            data, opcode = self.stream.read(size), head[0] & 15
            if opcode == 1:
                return json.loads(data)
            if opcode == 8:
                return struct.unpack("!H", data[:2])
        return None
