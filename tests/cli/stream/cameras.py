# SPDX-License-Identifier: BSD-3-Clause
"""Cameras in the network that a script plays, by HTTP and by RTSP."""
import contextlib
import socket
import threading


class Camera:
    """A camera in the network: `play(number, send)` is called for each connection."""

    def __init__(self, play):
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = "http://127.0.0.1:%d/video" % self.server.getsockname()[1]
        self.connections = []
        self.play = play
        self.thread = threading.Thread(target=self.serve)

    def serve(self):
        players = []
        with contextlib.suppress(OSError):
            while True:
                connection, _ = self.server.accept()
                self.connections.append(connection)
                players.append(threading.Thread(target=self.answer, args=(len(self.connections) - 1, connection)))
                players[-1].start()
        for player in players:
            player.join()

    def answer(self, number, connection):
        with contextlib.suppress(OSError):
            request = b""
            while b"\r\n\r\n" not in request:
                got = connection.recv(4096)
                if not got:
                    return
                request += got
            self.play(number, connection.sendall)
            connection.shutdown(socket.SHUT_RDWR)

    def close(self):
        for connection in [self.server, *self.connections]:
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)
            connection.close()

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.close()
        self.thread.join()


class RtspCamera(Camera):
    """The same in the words of RTSP (RFC 2326), with frames as RTP has JPEG (RFC 2435), all by one connection. With a
    `challenge`, a head such as b"WWW-Authenticate: ...", it lets nobody in."""

    SDP = b"v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=camera\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\nm=video 0 RTP/AVP 26\r\na=control:track\r\n"

    def __init__(self, play, challenge=b""):
        super().__init__(play)
        self.challenge = challenge
        self.address = self.address.replace("http", "rtsp")
        self.sequence = 0

    def answer(self, number, connection):
        lines = connection.makefile("rb")
        with contextlib.suppress(OSError):
            while True:
                request = list(iter(lambda: lines.readline().strip(), b""))
                if not request:
                    return
                sent = dict(line.split(b": ", 1) for line in request[1:])
                method = request[0].split()[0]
                head, body = b"", b""
                if method == b"DESCRIBE" and self.challenge:
                    connection.sendall(b"RTSP/1.0 401 Unauthorized\r\nCSeq: %s\r\n%s\r\n\r\n" % (sent[b"CSeq"], self.challenge))
                    continue
                if method == b"DESCRIBE":
                    head, body = b"Content-Type: application/sdp\r\nContent-Length: %d\r\n" % len(self.SDP), self.SDP
                if method == b"SETUP":
                    assert b"TCP" in sent[b"Transport"], sent
                    head = b"Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1\r\n"
                connection.sendall(b"RTSP/1.0 200 OK\r\nCSeq: %s\r\n%s\r\n%s" % (sent[b"CSeq"], head, body))
                if method == b"PLAY":
                    self.play(number, connection.sendall)
                    connection.shutdown(socket.SHUT_RDWR)
                    return

    def packets(self, jpeg, seconds):
        """An image as RTP packets: its tables and its scan, without its headers."""
        at, tables = 2, b""
        while True:
            code, length = jpeg[at + 1], int.from_bytes(jpeg[at + 2:at + 4], "big")
            segment = jpeg[at + 4:at + 2 + length]
            at += 2 + length
            if code == 0xDB:
                for i in range(0, len(segment), 65):
                    tables += segment[i + 1:i + 65]
            if code == 0xC0:
                height, width = (int.from_bytes(segment[i:i + 2], "big") for i in (1, 3))
                half = segment[7] == 0x22  # rows of colour, too
            if code == 0xDA:
                break
        scan, piece = jpeg[at:-2], 1200
        for start in range(0, len(scan), piece):
            last = start + piece >= len(scan)
            payload = bytes([0]) + start.to_bytes(3, "big") + bytes([1 if half else 0, 255, width // 8, height // 8])
            if start == 0:
                payload += bytes([0, 0]) + len(tables).to_bytes(2, "big") + tables
            payload += scan[start:start + piece]
            packet = bytes([0x80, 26 | (0x80 if last else 0)]) + self.sequence.to_bytes(2, "big")
            packet += (round(90000 * seconds) + 12345).to_bytes(4, "big") + bytes([0, 0, 0, 7]) + payload
            self.sequence = (self.sequence + 1) % 65536
            yield b"$\0" + len(packet).to_bytes(2, "big") + packet


HEAD = b"HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n"


def part(image):
    return b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n" % len(image) + image + b"\r\n"
