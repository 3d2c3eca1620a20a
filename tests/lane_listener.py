"""A lane whose messages are waited for."""

import queue

from solidtree.model.project.assets import default_store
from solidtree.model.worker.lane import Lane
from solidtree.model.worker.messages import Evaluated, Partitioned


class Listener:
    """Takes a lane's messages, and waits for one of a kind."""

    def __init__(self):
        self.messages = queue.Queue()
        self.seen = []
        self.lane = Lane(self.messages.put, default_store().folder)

    def wait_for(self, *kinds, request=None):
        while True:
            message = self.messages.get(timeout=60)
            self.seen.append(message)
            if isinstance(message, kinds) and request in (None, getattr(message, "request", None)):
                return message

    def evaluate(self, document, tolerance=0.05):
        return self.wait_for(Evaluated, request=self.lane.evaluate(document, tolerance))

    def partition(self, *meshes):
        return self.wait_for(Partitioned, request=self.lane.partition(meshes))
