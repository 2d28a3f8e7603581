# SPDX-License-Identifier: BSD-3-Clause
"""A network that takes its time between a client and a server on this machine, and counts.

    with far_network.between(port, seconds) as far:
        simple.Connect("localhost", far.port)
        before = far.counts()

It is a process of its own, because ParaView's client waits for the server without letting other
threads of Python run."""

import contextlib
import json
import queue
import socket
import subprocess
import sys
import threading
import time


class Far:
    """The end of it that a client connects to."""

    def __init__(self, process):
        self._process = process
        self.port = int(process.stdout.readline())

    def counts(self):
        """Since it began: "roundTrips", how often the client waited for an answer before it sent
        more; and the bytes "toClient" and "toServer"."""
        self._process.stdin.write("\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())


@contextlib.contextmanager
def between(port, seconds):
    """The way to a server's port. Each byte takes so many seconds, either way."""
    process = subprocess.Popen(["python3", __file__, str(port), str(seconds)], text=True,
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    try:
        yield Far(process)
    finally:
        process.terminate()
        process.wait()


class Way:
    """From one socket to the other, on threads of its own."""

    counts = {"roundTrips": 0, "toClient": 0, "toServer": 0}
    lock = threading.Lock()
    last = "toServer"

    def __init__(self, name, source, target, seconds):
        self.name, self.source, self.target, self.seconds = name, source, target, seconds
        self.under_way = queue.Queue()
        for work in (self.take, self.give):
            threading.Thread(target=work, daemon=True).start()

    def take(self):
        data = b"first"
        while data:
            try:
                data = self.source.recv(1 << 16)
            except OSError:
                data = b""
            with Way.lock:
                answered = data and self.name == "toServer" and Way.last == "toClient"
                Way.counts["roundTrips"] += 1 if answered else 0
                Way.counts[self.name] += len(data)
                Way.last = self.name if data else Way.last
            self.under_way.put((time.monotonic() + self.seconds, data))

    def give(self):
        while True:
            due, data = self.under_way.get()
            time.sleep(max(0.0, due - time.monotonic()))
            try:
                if not data:
                    self.target.shutdown(socket.SHUT_WR)
                    return
                self.target.sendall(data)
            except OSError:
                return


def main(port, seconds):
    listening = socket.create_server(("127.0.0.1", 0))
    print(listening.getsockname()[1], flush=True)

    def accept():
        while True:
            client, _ = listening.accept()
            server = socket.create_connection(("127.0.0.1", port))
            for end in (client, server):
                end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            Way("toServer", client, server, seconds)
            Way("toClient", server, client, seconds)
    threading.Thread(target=accept, daemon=True).start()
    for _ in sys.stdin:
        with Way.lock:
            print(json.dumps(Way.counts), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
