# SPDX-License-Identifier: BSD-3-Clause
"""What faults do to a flight's items. Each takes (items, context) and returns new items."""
import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import rospy
from flight import Item, of_kind, span
from rosgraph_msgs.msg import Clock

NAN, INFINITE = float("nan"), float("inf")


@dataclass
class Context:
    random: np.random.Generator
    other: Any  # the items of another flight, in another world

    def window_ns(self, items):
        """When faults last: from a third of the flight to its half."""
        return span(items, 1 / 3, 1 / 2)


def each(kinds, change, whole_flight=False):
    """A fault that changes each message of some kinds. change(message, number, context) changes a copy."""
    def fault(items, context):
        begin_ns, end_ns = context.window_ns(items)
        result, number = [], 0
        for item in items:
            if item.kind in kinds and (whole_flight or begin_ns <= item.time_ns < end_ns):
                item = replace(item, message=copy.deepcopy(item.message))
                change(item.message, number, context)
                number += 1
            result.append(item)
        return result
    return fault


def stream(kinds, change, whole_flight=False):
    """A fault of the stream: change(the window's items of these kinds, context) returns what comes in their place."""
    def fault(items, context):
        begin_ns, end_ns = (-1, 1 << 63) if whole_flight else context.window_ns(items)
        inside = [item for item in items if item.kind in kinds and begin_ns <= item.time_ns < end_ns]
        there = set(map(id, inside))
        result = [item for item in items if id(item) not in there] + change(inside, context)
        return sorted(result, key=lambda item: item.time_ns)  # stable: in their order where times are equal
    return fault


# Of the stream

def nothing(_inside, _context):
    return []


def dropped(share):
    def change(inside, context):
        times = sorted({item.time_ns for item in inside})
        kept = {time_ns for time_ns in times if context.random.random() >= share}
        return [item for item in inside if item.time_ns in kept]  # an image goes with its camera_info
    return change


def twice(inside, _context):
    return [one for item in inside for one in (item, replace(item, waits=False))]


def swapped(inside, _context):
    """The second of two comes before the first."""
    result = []
    for first, second in zip(inside[::2], inside[1::2]):
        result += [replace(second, time_ns=first.time_ns, waits=False), replace(first, time_ns=second.time_ns, waits=False)]
    return result + inside[len(inside) // 2 * 2:]


def bursts(size):
    """They come together when the last of them does."""
    def change(inside, _context):
        result = []
        for begin in range(0, len(inside), size):
            group = inside[begin:begin + size]
            result += [replace(item, time_ns=group[-1].time_ns, waits=item is group[-1]) for item in group]
        return result
    return change


def later(delay_ns):
    """They come later than their stamps say."""
    return lambda inside, _context: [replace(item, time_ns=item.time_ns + delay_ns) for item in inside]


def of_other_flight(kind):
    """Another flight's content under the stamps of this one."""
    def change(inside, context):
        result = []
        for item, other in zip(inside, of_kind(context.other, kind)[len(inside):]):
            message = copy.deepcopy(other.message)
            message.header = item.message.header
            result.append(replace(item, message=message))
        return result
    return change


def stamps_moved(offset_s, only=None):
    """From the window's begin on, of everything; or of one message alone."""
    def fault(items, context):
        begin_ns, _ = context.window_ns(items)
        result, done = [], False
        for item in items:
            if item.kind in ("image", "info", "odometry") and item.time_ns >= begin_ns and not (only and (done or item.kind != only)):
                done = True
                item = replace(item, message=copy.deepcopy(item.message))
                item.message.header.stamp += rospy.Duration.from_sec(offset_s)
            result.append(item)
        return result
    return fault


def images_stamped(later_s):
    """All images and their camera_info, which come at the time of their stamps."""
    def change(message, _number, _context):
        message.header.stamp += rospy.Duration.from_sec(later_s)

    def fault(items, context):
        moved = [replace(item, time_ns=item.time_ns + int(later_s * 1e9)) if item.kind in ("image", "info") else item
                 for item in each(("image", "info"), change, whole_flight=True)(items, context)]
        return sorted(moved, key=lambda item: item.time_ns)
    return fault


def played_again(items, _context):
    """The first half, then all of it from its beginning: a bag played in a loop."""
    _, end_ns = span(items, 0, 1 / 2)
    length_ns = end_ns - items[0].time_ns
    return [item for item in items if item.time_ns < end_ns] + [replace(item, time_ns=item.time_ns + length_ns) for item in items
                                                                if item.kind != "tf_static"]


def with_clock(change):
    """As a player publishes /clock: the stamp of each odometry message, before it."""
    def fault(items, context):
        result = []
        for item in change(items, context):
            if item.kind == "odometry":
                result.append(Item("clock", item.time_ns, Clock(item.message.header.stamp)))
            result.append(item)
        return result
    return fault


def done_at(share, call):
    def fault(items, _context):
        at_ns, _ = span(items, share, 1)
        return sorted(items + [Item("call", at_ns, call=call)], key=lambda item: item.time_ns)
    return fault


# Of an image

def pixels(change, whole_flight=False):
    """change(grey values of the image, number, context) gives others of the same size."""
    def apply(message, number, context):
        grey = np.frombuffer(message.data, np.uint8).reshape(message.height, message.width)
        message.data = np.ascontiguousarray(change(grey, number, context), np.uint8).tobytes()
    return each(("image",), apply, whole_flight)


def grey(value):
    return pixels(lambda image, _n, _c: np.full_like(image, value))


def saturated(image, _number, _context):
    return np.clip((image.astype(int) - 128) * 8 + 200, 0, 255)


def half_covered(image, _number, _context):
    """By something with texture that moves with the camera, such as a strap."""
    result = image.copy()
    pattern = np.random.default_rng(7).integers(0, 256, (image.shape[0] // 8, image.shape[1] // 16))
    result[:, :image.shape[1] // 2] = np.kron(pattern, np.ones((8, 8)))[:image.shape[0], :image.shape[1] // 2]
    return result


def noise(image, _number, context):
    return context.random.integers(0, 256, image.shape)


def stuck(inside, _context):
    images = of_kind(inside, "image")
    return [replace(item, message=_with_data(item.message, images[0].message.data)) if item.kind == "image" else item for item in inside]


def _with_data(message, data):
    message = copy.copy(message)
    message.data = data
    return message


def in_colour(message, _number, _context):
    message.encoding, message.step = "rgb8", 3 * message.width
    message.data = np.repeat(np.frombuffer(message.data, np.uint8), 3).tobytes()


def unknown_encoding(message, _number, _context):
    message.encoding = "foo8"


def cut_off(message, _number, _context):
    message.data = message.data[:len(message.data) // 2]


def cropped(message, _number, _context):
    """To the upper left quarter, of image or camera_info (whose principal point stays where it is)."""
    width, height = message.width // 2 + 40, message.height // 2 + 40
    if hasattr(message, "data"):
        image = np.frombuffer(message.data, np.uint8).reshape(message.height, message.width)
        message.data, message.step = np.ascontiguousarray(image[:height, :width]).tobytes(), width
    message.width, message.height = width, height


def mirrored(image, _number, _context):
    return image[:, ::-1]


# Of camera_info and tf

def turned(q, by):
    """Multiplies a message's quaternion from the left by w, x, y, z."""
    w, x, y, z = by
    q.w, q.x, q.y, q.z = (w * q.w - x * q.x - y * q.y - z * q.z, w * q.x + x * q.w + y * q.z - z * q.y,
                          w * q.y - x * q.z + y * q.w + z * q.x, w * q.z + x * q.y - y * q.x + z * q.w)


def calibration(value):
    def change(message, _number, _context):
        message.K, message.P = [value] * 9, [value] * 12
    return change


def calibration_field(value):
    """Another number of each camera_info is this one: all are gone through."""
    def change(message, number, _context):
        places = [(name, place) for name in "DKRP" for place in range(len(getattr(message, name)))]
        name, place = places[number % len(places)]
        values = list(getattr(message, name))
        values[place] = value
        setattr(message, name, values)
    return change


def focal_length(factor):
    def change(message, _number, _context):
        for matrix, places in (("K", (0, 4)), ("P", (0, 5))):
            values = list(getattr(message, matrix))
            for place in places:
                values[place] *= factor
            setattr(message, matrix, values)
    return change


def mounting(w_x_y_z):
    """Turned by this quaternion, or with a quaternion that is none."""
    def change(message, _number, _context):
        for transform in message.transforms:
            rotation = transform.transform.rotation
            turned(rotation, w_x_y_z)
    return change


def mounting_position(value):
    def change(message, _number, _context):
        for transform in message.transforms:
            transform.transform.translation.x = value
    return change


# Of odometry

def fields_of_odometry():
    """A setter for each number of a message."""
    parts = [("pose.pose.position", "x y z"), ("pose.pose.orientation", "x y z w"), ("twist.twist.linear", "x y z"), ("twist.twist.angular", "x y z")]
    setters = []
    for path, names in parts:
        for name in names.split():
            def setter(message, value, path=path, name=name):
                for part in path.split("."):
                    message = getattr(message, part)
                setattr(message, name, value)
            setters.append(setter)
    for part in ("pose", "twist"):
        for place in range(36):
            def setter(message, value, part=part, place=place):
                values = list(getattr(message, part).covariance)
                values[place] = value
                getattr(message, part).covariance = values
            setters.append(setter)
    return setters


def one_field(value):
    """Another number of each message is not finite: all are gone through."""
    setters = fields_of_odometry()
    return lambda message, number, _context: setters[number % len(setters)](message, value)


def odometry_jump(metres):
    """From the window's begin on it is elsewhere."""
    def fault(items, context):
        begin_ns, _ = context.window_ns(items)
        return _odometry_from(items, begin_ns, lambda p: setattr(p.position, "x", p.position.x + metres))
    return fault


def restarted_elsewhere(items, context):
    """It stops for the window, then begins at the origin with heading 0, as of a driver that was started again."""
    begin_ns, end_ns = context.window_ns(items)
    first = next(item.message.pose.pose for item in of_kind(items, "odometry") if item.time_ns >= end_ns)
    origin, turn = copy.deepcopy(first.position), _yaw(first.orientation)

    def change(pose):
        dx, dy = pose.position.x - origin.x, pose.position.y - origin.y
        pose.position.x, pose.position.y = np.cos(-turn) * dx - np.sin(-turn) * dy, np.sin(-turn) * dx + np.cos(-turn) * dy
        turned(pose.orientation, (np.cos(turn / 2), 0, 0, -np.sin(turn / 2)))
    kept = [item for item in items if not (item.kind == "odometry" and begin_ns <= item.time_ns < end_ns)]
    return _odometry_from(kept, end_ns, change)


def _yaw(q):
    return float(np.arctan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)))


def _odometry_from(items, begin_ns, change):
    result = []
    for item in items:
        if item.kind == "odometry" and item.time_ns >= begin_ns:
            item = replace(item, message=copy.deepcopy(item.message))
            change(item.message.pose.pose)
        result.append(item)
    return result


def frozen(inside, _context):
    """The same pose under new stamps."""
    result = []
    for item in inside:
        message = copy.deepcopy(inside[0].message)
        message.header = item.message.header
        result.append(replace(item, message=message))
    return result


def mirrored_yaw(message, _number, _context):
    message.pose.pose.position.y *= -1
    message.pose.pose.orientation.z *= -1
    message.pose.pose.orientation.x *= -1


# Of features, between tracker and mapper

def wrong_matches(share):
    """A share of the features have each other's tracks and descriptors."""
    def change(message, random):
        count = len(message.x)
        chosen = np.flatnonzero(random.random(count) < share)
        if len(chosen) < 2:
            return message
        wrong, order = copy.copy(message), np.arange(count)
        order[chosen] = np.roll(chosen, 1)
        descriptors = np.frombuffer(bytes(message.descriptor), np.uint8).reshape(count, -1)
        wrong.descriptor = descriptors[order].tobytes()
        wrong.track_id, wrong.age = list(np.array(message.track_id)[order]), list(np.array(message.age)[order])
        return wrong
    return change


def feature_field(value):
    """Another field of each message holds a number that is not finite."""
    fields = ("x", "y", "bearing", "information")
    state = {"number": 0}

    def change(message, _random):
        wrong = copy.copy(message)
        name = fields[state["number"] % (2 * len(fields)) // 2]
        if state["number"] % 2 == 0 and getattr(message, name):  # every other message is good
            values = list(getattr(message, name))
            values[len(values) // 2] = value
            setattr(wrong, name, values)
        state["number"] += 1
        return wrong
    return change
