"""System: callbacks; threads; what it refuses."""

import copy
import gc
import os
import pickle
import subprocess
import sys
import threading
import unittest

import numpy as np

import sslam
from room import ROOM, frames, needs_room, poses_of, system, track_all


@needs_room
class Callbacks(unittest.TestCase):
    def test_callbacks_hear_of_their_events(self):
        tracker = system()
        heard = {event: 0 for event in sslam.EVENTS}

        def count(event):
            def one(_):
                heard[event] += 1

            return one

        for event in sslam.EVENTS:
            tracker.on(event, count(event))
        results = track_all(tracker)
        self.assertEqual(heard["frame_tracked"], 60)
        self.assertEqual(heard["keyframe_made"], sum(r.keyframe for r in results))
        self.assertEqual(heard["map_changed"], sum(r.map_changed for r in results))
        self.assertGreater(heard["map_changed"], 0)

    def test_a_callback_may_use_the_system_and_take_itself_off(self):
        tracker = system()
        sizes = []

        @lambda callback: tracker.on("frame_tracked", callback)
        def look(result):
            sizes.append(len(tracker.points()))
            worker = threading.Thread(target=tracker.trajectory)
            worker.start()
            worker.join()  # another thread gets its turn meanwhile
            if result.index == 4:
                tracker.off("frame_tracked", look)

        track_all(tracker, count=10)
        self.assertEqual(len(sizes), 5)

    def test_what_a_callback_raises_comes_out_of_track_and_the_frame_counts(self):
        tracker = system()

        def fail(result):
            raise KeyError("mine")

        tracker.on("frame_tracked", fail)
        with self.assertRaisesRegex(KeyError, "mine"):
            tracker.track(frames()[0].image, 0.0)
        self.assertEqual(tracker.frames, 1)
        tracker.off("frame_tracked", fail)
        tracker.track(frames()[1].image, 1.0)
        self.assertEqual(tracker.frames, 2)

        def no_normals(image):
            raise OSError("no model")

        blind = system(normals=no_normals)
        with self.assertRaisesRegex(OSError, "no model"):
            blind.track(frames()[0].image, 0.0)
        self.assertEqual(blind.frames, 0)

    def test_unknown_events_and_callbacks_are_refused(self):
        tracker = system()
        with self.assertRaisesRegex(ValueError, "^event: "):
            tracker.on("frame_track", print)
        with self.assertRaisesRegex(TypeError, "^callback: "):
            tracker.on("frame_tracked", 5)
        with self.assertRaisesRegex(ValueError, "^callback: "):
            tracker.off("frame_tracked", print)


@needs_room
class Faults(unittest.TestCase):
    def refuses(self, kind, start, function, /, *args, **keywords):
        with self.assertRaises(kind) as caught:
            function(*args, **keywords)
        message = str(caught.exception)
        self.assertTrue(message.startswith(start), message)
        self.assertNotIn("\n", message)

    def test_what_is_no_image_is_refused_by_its_name_and_changes_nothing(self):
        tracker, image = system(), frames()[0].image
        self.refuses(TypeError, "image: has dtype float32", tracker.track, image.astype(np.float32), 0.0)
        self.refuses(TypeError, "image: ", tracker.track, image.tolist(), 0.0)
        self.refuses(TypeError, "image: ", tracker.track, None, 0.0)
        self.refuses(ValueError, "image: has shape", tracker.track, image[:, :, :2], 0.0)
        self.refuses(ValueError, "image: has shape", tracker.track, image.ravel(), 0.0)
        self.refuses(ValueError, "image: is empty", tracker.track, image[:0], 0.0)
        self.refuses(ValueError, "image: has 160x240", tracker.track, image[:, :160], 0.0)
        self.refuses(ValueError, "mask: ", tracker.track, image, 0.0, mask=np.ones((2, 2), np.uint8))
        self.refuses(TypeError, "mask: ", tracker.track, image, 0.0, mask=np.ones((240, 320)))
        self.refuses(ValueError, "depth: ", tracker.track, image, 0.0, depth=np.ones((2, 2), np.uint16))
        self.refuses(TypeError, "depth: ", tracker.track, image, 0.0, depth=np.ones((240, 320), np.int64))
        self.refuses(ValueError, "normals: ", tracker.track, image, 0.0, normals=np.ones((240, 240, 3), np.float32))
        self.refuses(ValueError, "normals: ", tracker.track, image, 0.0, normals=np.ones((60, 80), np.float32))
        self.refuses(TypeError, "normals: ", tracker.track, image, 0.0, normals=np.ones((60, 80, 3), np.uint8))
        self.refuses(TypeError, "name: ", tracker.track, image, 0.0, name=5)
        self.refuses(ValueError, "name: ", tracker.track, image, 0.0, name="\udc80")
        self.refuses(TypeError, "image: has dtype >f4", tracker.track, image.astype(">f4"), 0.0)
        self.refuses(TypeError, "depth: has dtype >u2", tracker.track, image, 0.0, depth=np.ones((240, 320), ">u2"))
        self.refuses(ValueError, "image: has shape ()", tracker.track, np.uint8(3), 0.0)
        self.refuses(TypeError, "on: ", tracker.localise_only, np.ones(3))
        self.assertEqual(tracker.frames, 0)

    def test_stamps_must_be_numbers_that_grow(self):
        tracker, image = system(), frames()[0].image
        tracker.track(image, 5.0)
        for stamp in (float("nan"), float("inf"), 5.0, 4.0):
            self.refuses(ValueError, "stamp: ", tracker.track, image, stamp)
        for stamp in ("6", None, [6.0], np.zeros(2), np.zeros((9, 99)), 10**400, 1j):
            self.refuses(TypeError, "stamp: ", tracker.track, image, stamp)
        self.assertEqual(tracker.frames, 1)
        tracker.track(image, np.float32(6))

    def test_calls_after_finish_are_refused(self):
        tracker = system()
        tracker.track(frames()[0].image, 0.0)
        tracker.finish()
        self.assertFalse(tracker.finish())
        self.refuses(sslam.FinishedError, "track: ", tracker.track, frames()[1].image, 1.0)
        self.refuses(sslam.FinishedError, "load: ", tracker.load, "map.sslam")
        self.refuses(sslam.FinishedError, "localise_only: ", tracker.localise_only)
        self.assertEqual(tracker.points().shape[1], 3)

    def test_settings_that_make_no_sense_are_refused_by_their_name(self):
        camera = ROOM / "camera.yaml"
        self.refuses(sslam.SettingsError, "preset: ", sslam.System, camera, "structur")
        self.refuses(sslam.SettingsError, "live: ", sslam.System, camera, "paper", live=True, normals="none")
        self.refuses(sslam.SettingsError, "parameters: keyframe.max_turn", sslam.System, camera, normals="none", parameters={"keyframe.max_turn": 3})
        self.refuses(sslam.SettingsError, "parameters: keyframes.max_turn", sslam.System, camera, normals="none", keyframes__max_turn=1000)
        self.refuses(TypeError, "keyframes.max_turn: ", sslam.System, camera, parameters={"keyframes.max_turn": "a"})
        self.refuses(TypeError, "System: no argument sed", sslam.System, camera, sed=1)
        self.refuses(sslam.SettingsError, "normals: ", sslam.System, camera, normals="files:/nowhere")
        self.refuses(sslam.SettingsError, "normals: ", sslam.System, camera, normals="dept")
        self.refuses(sslam.SettingsError, "normals: ", sslam.System, camera, normals="onnx:/nowhere.onnx")
        self.refuses(TypeError, "normals: ", sslam.System, camera, normals=5)
        self.refuses(ValueError, "colours: ", sslam.System, camera, colours="gbr")
        self.refuses(ValueError, "longest_side: ", sslam.System, camera, longest_side=-1)
        self.refuses(ValueError, "depth_factor: ", sslam.System, camera, depth_factor=0)
        self.refuses(TypeError, "live: ", sslam.System, camera, live="no")
        self.refuses(ValueError, "preset: ", sslam.System, camera, "\udc80")
        self.refuses(ValueError, "event: ", system().on, ["warning"], print)
        self.refuses(TypeError, "camera: ", sslam.System, 5)
        self.refuses(sslam.Error, "/nowhere.yaml: ", sslam.System, "/nowhere.yaml")
        self.refuses(ValueError, "fx: ", sslam.Camera, float("nan"), 1, 1, 1, 640, 480)
        self.refuses(TypeError, "fy: ", sslam.Camera, 500, "500", 320, 240, 640, 480)
        self.refuses(TypeError, "k1: ", sslam.Camera, 500, 500, 320, 240, 640, 480, k1=None)
        self.refuses(TypeError, "height: ", sslam.Camera, 500, 500, 320, 240, 640, 480.0)
        self.refuses(ValueError, "width: ", sslam.Camera, 500, 500, 320, 240, 2**40, 480)
        self.refuses(TypeError, "path: ", sslam.Camera.from_file, None)
        self.refuses(ValueError, "width: ", sslam.Camera, 500, 500, 320, 240, 0, 480)
        self.refuses(ValueError, "camera: ", sslam.Camera, 1, 1, 320, 240, 640, 480)
        self.refuses(sslam.Error, "/nowhere/map.sslam: ", sslam.load_map, "/nowhere/map.sslam")
        self.refuses(sslam.Error, "/nowhere/", system().save, "/nowhere/map.sslam")
        self.refuses(ValueError, "path: ", system().save, "")
        self.refuses(TypeError, "path: ", system().save, 5)

    def test_cameras_are_copied_and_sent_to_other_processes_and_systems_are_not(self):
        camera = sslam.Camera(500, 501, 320, 240, 640, 480, k1=0.1)
        for twin in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
            self.assertEqual((twin, hash(twin), repr(twin)), (camera, hash(camera), repr(camera)))
        self.assertNotEqual(camera, sslam.Camera(500, 501, 320, 240, 640, 480))
        self.assertNotEqual(camera, 5)
        tracker = system()
        for call in (copy.copy, copy.deepcopy, pickle.dumps):
            self.refuses(TypeError, "System: cannot be copied", call, tracker)

    def test_an_empty_map_says_that_it_is_one(self):
        path = f"/tmp/sslam_empty_{os.getpid()}.sslam"
        self.addCleanup(os.unlink, path)
        system().save(path)
        self.refuses(sslam.Error, f"{path}: is an empty map", sslam.load_map, path)

    def test_parameters_have_names_values_and_defaults(self):
        self.assertIn("structure", [p.name for p in sslam.presets()])
        default = {p.name: p.value for p in sslam.parameters()}
        used = {p.name: p.value for p in system(keyframes__max_turn=9).parameters()}
        self.assertEqual(used["keyframes.max_turn"], 9)
        self.assertEqual([n for n in default if default[n] != used[n]], ["keyframes.max_turn"])


@needs_room
class Threads(unittest.TestCase):
    def test_threads_take_turns(self):
        tracker = system()
        stop = threading.Event()
        looked = [0]

        def look():
            while not stop.is_set():
                tracker.points(), tracker.trajectory(), tracker.keyframes(), tracker.latest()
                looked[0] += 1

        readers = [threading.Thread(target=look) for _ in range(2)]
        for reader in readers:
            reader.start()
        results = track_all(tracker, count=30)
        stop.set()
        for reader in readers:
            reader.join()
        self.assertGreater(looked[0], 0)
        self.assertEqual(poses_of(results), poses_of(track_all(system(), count=30)))

    def test_of_two_threads_that_track_one_is_told_that_its_stamp_is_late(self):
        tracker = system()
        outcomes = []

        def track():
            try:
                tracker.track(frames()[0].image, 1.0)
                outcomes.append("tracked")
            except ValueError as error:
                outcomes.append(str(error)[:6])

        threads = [threading.Thread(target=track) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(outcomes), ["stamp:"] * 3 + ["tracked"])

    def test_other_threads_run_while_a_frame_is_tracked(self):
        tracker = system()
        inside, counted = threading.Event(), []

        def count():
            while not inside.is_set():
                counted.append(1)

        counter = threading.Thread(target=count)
        tracker.on("frame_tracked", lambda result: inside.set() if result.index == 5 else None)
        counter.start()
        track_all(tracker, count=6)
        counter.join()
        self.assertGreater(len(counted), 1000)

    def test_references_dropped_in_odd_orders(self):
        camera = sslam.Camera.from_file(ROOM / "camera.yaml")

        def one():
            tracker = sslam.System(camera, normals="none")
            callback = tracker.on("frame_tracked", lambda result: tracker)  # a cycle
            result = tracker.track(frames()[0].image.copy(), 0.0)
            del tracker
            return callback, result.pose, result.timings

        kept = []
        threads = [threading.Thread(target=lambda: kept.append(one())) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(kept), 3)
        del kept
        gc.collect()


@needs_room
class Processes(unittest.TestCase):
    def child(self, act):
        pid = os.fork()
        if pid == 0:
            code = 1
            try:
                code = 0 if act() else 2
            finally:
                os._exit(code)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), 0)

    def test_after_a_fork_the_parents_system_is_refused_and_an_own_one_works(self):
        for live in (False, True):
            box = [system(live=live)]
            track_all(box[0], count=5)

            def refused():
                try:
                    box[0].track(frames()[6].image, 100.0)
                except sslam.Error as error:
                    box.clear()  # which leaves the parent's threads alone
                    return str(error).startswith("System: was made before this process was forked")

            self.child(refused)
            self.child(lambda: track_all(system(live=live), count=5))
            box[0].finish()

    def test_python_ends_while_another_thread_tracks(self):
        code = f"""
import itertools, sys, threading, sslam
frames = list(sslam.open_dataset({str(ROOM)!r}, end=20))
system = sslam.System({str(ROOM / "camera.yaml")!r}, normals="none")
started = threading.Event()
system.on("frame_tracked", lambda result: started.set())
def track():
    for i in itertools.count():
        system.track(frames[i % 20].image, i)
threading.Thread(target=track, daemon=True).start()
started.wait()
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
