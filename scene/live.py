"""The live scene on the bus where a camera sees the table: look, detect, track, tell.

A snapshot query waits for pictures taken after it was asked, so that who moved something and then
asks sees what came of it. Where the camera gives no picture, what was seen last is told as such.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import msgspec

from agent.bus import Bus, Closing
from agent.errors import ArmchatError, CameraError, Declined
from agent.messages import PictureInfo, SceneCall, SceneEvent, SceneSnapshot
from agent.wire import Message
from scene.eye import Eye, Seen, Sight, look_at, sight
from scene.robot_word import RobotWord
from scene.sight import Camera, Picture, Pixels
from scene.track import LIVE, call
from scene.tracks import Event, Hint

log = logging.getLogger(__name__)

FRESH = LIVE.confirm + 1
"""Pictures taken after a question that make its answer: as many as make a thing believed, and one
more, for it may be missed in one."""

Encode = Callable[[Pixels], bytes]
"""A picture (height, width, 3), RGB, as a JPEG file."""


class Pace(NamedTuple):
    """Pictures a second that are looked at, and that are told; seconds to wait for fresh ones."""

    looks: float = 10.0
    pictures: float = 2.0
    patience: float = 12.0


class EyeService:
    """Serves ``scene/<name>/...`` from a camera that the caller opened and closes.

    ``seen`` is what is known beforehand: what waits in the tray, the table's side.
    """

    def __init__(
        self,
        bus: Bus,
        camera: Camera,
        eye: Eye,
        encode: Encode,
        *,
        word: RobotWord | None = None,
        seen: Seen = Seen(),  # noqa: B008 - an immutable value
        pace: Pace = Pace(),  # noqa: B008
        robot: str = "r1",
        name: str = "main",
        camera_name: str = "top",
    ) -> None:
        self.name = name
        self._bus, self._camera, self._eye, self._encode = bus, camera, eye, encode
        self._word, self._pace, self._robot = word or RobotWord(), pace, robot
        self._picture_key = bus.keys.camera(name, camera_name)
        self._news = threading.Condition()
        self._seen, self._sight = seen, sight(seen, 0.0, Hint())
        self._picture: Picture | None = None
        self._taken: list[float] = []
        self._lost = "no picture yet"
        self._seq = 0
        self._shown = float("-inf")
        self._closing = threading.Event()
        self._declared: list[Closing] = []
        self._looker: threading.Thread | None = None

    def start(self) -> None:
        """Look and serve; the service's token comes last."""
        bus, keys = self._bus, self._bus.keys
        self._declared = [
            *self._word.listen(bus, self._robot),
            bus.serve(keys.snapshot(self.name), self._on_snapshot),
            bus.serve(keys.call(self.name), self._on_call),
            bus.serve_raw(self._picture_key, self._on_picture),
        ]
        self._looker = threading.Thread(target=self._looking, name="eye", daemon=True)
        self._looker.start()
        self._declared.append(bus.token(keys.alive("scene", self.name)))

    def close(self) -> None:
        """Withdraw from the bus."""
        self._closing.set()
        with self._news:
            self._news.notify_all()
        for closing in reversed(self._declared):
            closing.close()
        self._declared.clear()
        if self._looker is not None:
            self._looker.join(timeout=2.0)

    # --- looking --------------------------------------------------------------------------------

    def _looking(self) -> None:
        while not self._closing.is_set():
            began = time.monotonic()
            try:
                self._look()
            except CameraError as error:
                self._lose(str(error))
            except Exception as error:
                log.exception("the eye failed on a picture")
                self._lose(f"the eye failed ({type(error).__name__}: {error})")
            self._closing.wait(max(0.0, began + 1 / self._pace.looks - time.monotonic()))

    def _look(self) -> None:
        """One picture, from the camera to the bus."""
        picture = self._camera.look()
        if self._picture is not None and picture.t <= self._picture.t and not self._lost:
            return
        with self._news:
            seen = self._seen
        after, new = look_at(seen, picture, self._eye, self._word.hint())
        with self._news:
            self._seen, self._sight = self._merged(seen, after), new
            self._picture, self._lost = picture, ""
            self._taken = [*self._taken[-FRESH + 1 :], picture.t]
            self._news.notify_all()
        self._tell(new.events)
        if picture.t - self._shown >= 1 / self._pace.pictures:
            self._shown = picture.t
            data, metadata = self._packed(picture)
            self._bus.publish_raw(self._picture_key, data, attachment=metadata)
        self._eye.settle()

    def _merged(self, before: Seen, after: Seen) -> Seen:
        """What was seen, with the names that were given meanwhile."""
        if self._seen is before:
            return after
        names = {one.id: one.called for one in self._seen.tracks.known if one.called}
        tracks = after.tracks
        for one in tracks.known:
            if one.id in names:
                tracks = call(tracks, one.id, str(names[one.id]))
        return replace(after, tracks=tracks)

    def _lose(self, why: str) -> None:
        """No picture: said once, and then again only when it is another reason."""
        with self._news:
            told, self._lost = self._lost == why, why
            self._taken = []
        if not told:
            log.warning("no picture: %s", why)
            self._tell(())

    def _tell(self, events: tuple[Event, ...]) -> None:
        self._bus.publish(self._bus.keys.objects(self.name), self._snapshot(events))

    def _snapshot(self, events: tuple[Event, ...] = ()) -> SceneSnapshot:
        with self._news:
            self._seq += 1
            now: Sight = self._sight
            return SceneSnapshot(
                self._seq, time.time(), now.scene, dict(now.sd), dict(now.unseen),
                tuple(SceneEvent(*event) for event in events), "lost" if self._lost else "ok",
                dict(now.tall_sd), dict(now.stands),
            )  # fmt: skip

    # --- being asked ----------------------------------------------------------------------------

    def _on_snapshot(self, key: str, request: Message | None) -> SceneSnapshot:
        asked = time.time()

        def fresh() -> bool:
            enough = len(self._taken) == FRESH and self._taken[0] >= asked
            return enough or self._closing.is_set()

        with self._news:
            if not self._news.wait_for(fresh, self._pace.patience) or self._closing.is_set():
                raise Declined("no_view", self._lost or "no new picture in time")
        return self._snapshot()

    def _on_call(self, key: str, request: Message | None) -> SceneSnapshot:
        if not isinstance(request, SceneCall) or not request.name.strip():
            raise Declined("bad_payload", "call takes a SceneCall with an id and a name")
        with self._news:
            seen = self._seen
            tracks = call(seen.tracks, request.id, request.name.strip())
            self._seen = replace(seen, tracks=tracks)
            self._sight = sight(self._seen, tracks.t or 0.0, self._word.hint())
        return self._snapshot()

    def _on_picture(self, key: str) -> tuple[bytes, bytes]:
        with self._news:
            picture, lost = self._picture, self._lost
        if picture is None or lost:
            raise Declined("no_view", lost)
        return self._packed(picture)

    def _packed(self, picture: Picture) -> tuple[bytes, bytes]:
        """The picture as JPEG, and its metadata."""
        height, width, _ = picture.pixels.shape
        view = self._eye.view
        info = PictureInfo(
            picture.t, width, height, "jpeg",
            tuple(float(one) for one in view.homography.ravel()), view.camera,
        )  # fmt: skip
        try:
            return self._encode(picture.pixels), msgspec.json.encode(info)
        except ArmchatError as error:
            raise Declined("no_view", str(error)) from error
