/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What vslam_onboard and a flight controller tell each other, by UDP or as the same records one
 * after the other in a file or FIFO. C99 without libraries, so that a controller generated from
 * Simulink can include it. All numbers are little endian whatever the processor; doubles are IEEE
 * 754. Lengths in metres, angles in radians, stamps in nanoseconds of one clock (CLOCK_MONOTONIC by
 * default) for images and observer. Quaternions are x, y, z, w.
 *
 * Each record: magic, version, kind, size, sequence, fields in the order below, CRC-32 (as zlib's)
 * of all bytes before it.
 *
 * A controller sends, for each state of its observer:
 *   VslamObserver o;
 *   memset(&o, 0, sizeof o);
 *   o.sequence = ++count; o.stamp_ns = now; o.position_m[0] = ...; o.quaternion[3] = 1;
 *   uint8_t bytes[VSLAM_OBSERVER_BYTES];
 *   vslam_write_observer(&o, bytes);
 *   sendto(socket, bytes, sizeof bytes, ...);
 * and reads what comes back with vslam_read_pose.
 */
#ifndef VSLAM_PROTOCOL_H
#define VSLAM_PROTOCOL_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum {
  VSLAM_VERSION = 1,
  VSLAM_KIND_OBSERVER = 1,
  VSLAM_KIND_POSE = 2,
  VSLAM_KIND_TELEMETRY = 3, /* telemetry.hpp */
  VSLAM_HEADER_BYTES = 12,
  VSLAM_CRC_BYTES = 4,
  VSLAM_OBSERVER_BYTES = 140,
  VSLAM_POSE_BYTES = 204,
  VSLAM_OBSERVER_HAS_VARIANCE = 1,
  VSLAM_OBSERVER_HAS_HEIGHT = 2,
  VSLAM_POSE_IS_VALID = 1,
  /* What frame_budget_ms left this image no time for, in the order of the core's OptionalWork. */
  VSLAM_POSE_WITHOUT_PLACE_SEARCH = 2,
  VSLAM_POSE_WITHOUT_LANDMARKS = 4,
  VSLAM_POSE_WITHOUT_KEYFRAME = 8
};
#define VSLAM_MAGIC 0x4D4C5356u /* "VSLM" */

/* States of VslamPose: below 32 the core's SlamState, in its order. */
enum {
  VSLAM_BUILDING_MAP = 0,
  VSLAM_LOCALISED = 1,
  VSLAM_TOO_FEW_LANDMARKS = 2,
  VSLAM_FIX_REJECTED = 3,
  VSLAM_OBSERVER_ONLY = 4,
  VSLAM_NOT_FINITE = 5,
  VSLAM_TRACKING = 6,
  VSLAM_RESTING = 7,
  VSLAM_ROTATING = 8,
  VSLAM_RELOCATED = 9,
  VSLAM_DISTRUSTED = 10,
  VSLAM_SEARCHING_MAP =
      11, /* not found yet in a loaded map, or after a restart: the pose is beside another origin */
  VSLAM_BLIND = 12, /* hardly a corner is followed: the pose goes on by the observer's way */
  VSLAM_LAST_STATE = VSLAM_BLIND, /* of those with a pose */
  /* From here on there is no pose. */
  VSLAM_WAITING_FOR_IMAGES = 32,
  VSLAM_CAMERA_LOST = 33,       /* missing, gone, or silent */
  VSLAM_CONTROLLER_SILENT = 34, /* no good record of the observer for half a second */
  VSLAM_NO_OBSERVER = 35,       /* records come, but none for the image's stamp */
  VSLAM_ENDING = 36,            /* the last record before the program ends */
  VSLAM_OUT_OF_MEMORY = 37      /* the map begins anew: raise working_mb */
};

/* The controller's estimate of one instant. */
typedef struct VslamObserver {
  uint32_t sequence; /* one more for each record; one that is not newer is dropped */
  uint32_t flags;    /* VSLAM_OBSERVER_HAS_... */
  int64_t stamp_ns;
  double position_m[3]; /* of base in odom: the frame that drifts, z up */
  double quaternion[4]; /* base to odom; base: x forward, y left, z up */
  double variance[6];   /* position [m^2], rotation vector [rad^2], axes of odom; their growth tells
                           the drift. Beyond 0 .. 1e4 m^2 they count as not given */
  double height_m;      /* of base above the floor, measured at the stamp */
} VslamObserver;

/* The answer to one image; without VSLAM_POSE_IS_VALID only sequence, state and counters mean
 * something. */
typedef struct VslamPose {
  uint32_t sequence;
  uint32_t flags; /* VSLAM_POSE_... */
  uint32_t state;
  int64_t stamp_ns; /* the image's; the pose is of its exposure: that plus image_time_offset_s */
  double position_m[3]; /* fused, of base in map: equals odom at the first image */
  double quaternion[4]; /* base to map */
  double deviation[6];  /* standard deviations: position [m], rotation vector [rad], axes of map */
  double observer_position_m[3]; /* the observer's estimate at that instant that the fused pose
                                    started from, in odom */
  double observer_quaternion[4];
  uint32_t frames_dropped;  /* newer ones came, bad stamps, or no observer: since the start */
  uint32_t records_dropped; /* observer records: short, corrupted, old, out of bounds */
  uint32_t landmarks;       /* in the map */
} VslamPose;

static inline uint32_t vslam_crc32(const uint8_t* bytes, size_t count) {
  static const uint32_t kNibble[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu,
                                       0x76DC4190u, 0x6B6B51F4u, 0x4DB26158u, 0x5005713Cu,
                                       0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                       0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};
  uint32_t crc = 0xFFFFFFFFu;
  size_t i;
  for (i = 0; i < count; ++i) {
    crc ^= bytes[i];
    crc = (crc >> 4) ^ kNibble[crc & 15u];
    crc = (crc >> 4) ^ kNibble[crc & 15u];
  }
  return ~crc;
}

/* Writers and readers return the byte behind what they wrote or read. */
static inline uint8_t* vslam_put(uint8_t* to, uint64_t value, int bytes) {
  int i;
  for (i = 0; i < bytes; ++i) to[i] = (uint8_t)(value >> (8 * i) & 255u);
  return to + bytes;
}

static inline const uint8_t* vslam_get(const uint8_t* from, uint64_t* value, int bytes) {
  int i;
  *value = 0;
  for (i = 0; i < bytes; ++i) *value |= (uint64_t)from[i] << (8 * i);
  return from + bytes;
}

static inline const uint8_t* vslam_get_u32(const uint8_t* from, uint32_t* value) {
  uint64_t wide;
  from = vslam_get(from, &wide, 4);
  *value = (uint32_t)wide;
  return from;
}

static inline const uint8_t* vslam_get_i64(const uint8_t* from, int64_t* value) {
  uint64_t wide;
  from = vslam_get(from, &wide, 8);
  memcpy(value, &wide, sizeof *value);
  return from;
}

static inline uint8_t* vslam_put_doubles(uint8_t* to, const double* values, int count) {
  int i;
  for (i = 0; i < count; ++i) {
    uint64_t bits;
    memcpy(&bits, &values[i], sizeof bits);
    to = vslam_put(to, bits, 8);
  }
  return to;
}

static inline const uint8_t* vslam_get_doubles(const uint8_t* from, double* values, int count) {
  int i;
  for (i = 0; i < count; ++i) {
    uint64_t bits;
    from = vslam_get(from, &bits, 8);
    memcpy(&values[i], &bits, sizeof bits);
  }
  return from;
}

static inline uint8_t* vslam_put_header(uint8_t* to, int kind, size_t size, uint32_t sequence) {
  to = vslam_put(to, VSLAM_MAGIC, 4);
  to = vslam_put(to, VSLAM_VERSION, 1);
  to = vslam_put(to, (uint64_t)kind, 1);
  to = vslam_put(to, size, 2);
  return vslam_put(to, sequence, 4);
}

/* Closes a record of `size` bytes, CRC included. */
static inline void vslam_put_crc(uint8_t* record, size_t size) {
  vslam_put(record + size - VSLAM_CRC_BYTES, vslam_crc32(record, size - VSLAM_CRC_BYTES), 4);
}

/* What a record is worth. */
typedef enum VslamFault {
  VSLAM_GOOD = 0,
  VSLAM_WRONG_SIZE, /* shorter or longer than it says or must be */
  VSLAM_WRONG_KIND, /* another magic, version or kind */
  VSLAM_CORRUPTED   /* its CRC is another */
} VslamFault;

static inline VslamFault vslam_check(const uint8_t* record, size_t count, int kind, size_t size) {
  uint64_t magic, said, crc;
  if (count < VSLAM_HEADER_BYTES) return VSLAM_WRONG_SIZE;
  vslam_get(record, &magic, 4);
  vslam_get(record + 6, &said, 2);
  if (magic != VSLAM_MAGIC || record[4] != VSLAM_VERSION || record[5] != kind)
    return VSLAM_WRONG_KIND;
  if (said != size || count != size) return VSLAM_WRONG_SIZE;
  vslam_get(record + size - VSLAM_CRC_BYTES, &crc, 4);
  return crc == vslam_crc32(record, size - VSLAM_CRC_BYTES) ? VSLAM_GOOD : VSLAM_CORRUPTED;
}

static inline void vslam_write_observer(const VslamObserver* o,
                                        uint8_t record[VSLAM_OBSERVER_BYTES]) {
  uint8_t* to = vslam_put_header(record, VSLAM_KIND_OBSERVER, VSLAM_OBSERVER_BYTES, o->sequence);
  to = vslam_put(to, o->flags, 4);
  to = vslam_put(to, (uint64_t)o->stamp_ns, 8);
  to = vslam_put_doubles(to, o->position_m, 3);
  to = vslam_put_doubles(to, o->quaternion, 4);
  to = vslam_put_doubles(to, o->variance, 6);
  vslam_put_doubles(to, &o->height_m, 1);
  vslam_put_crc(record, VSLAM_OBSERVER_BYTES);
}

/* `observer` is written only when the answer is VSLAM_GOOD. */
static inline VslamFault vslam_read_observer(const uint8_t* record, size_t count,
                                             VslamObserver* observer) {
  const VslamFault fault = vslam_check(record, count, VSLAM_KIND_OBSERVER, VSLAM_OBSERVER_BYTES);
  if (fault != VSLAM_GOOD) return fault;
  record = vslam_get_u32(record + 8, &observer->sequence);
  record = vslam_get_u32(record, &observer->flags);
  record = vslam_get_i64(record, &observer->stamp_ns);
  record = vslam_get_doubles(record, observer->position_m, 3);
  record = vslam_get_doubles(record, observer->quaternion, 4);
  record = vslam_get_doubles(record, observer->variance, 6);
  vslam_get_doubles(record, &observer->height_m, 1);
  return VSLAM_GOOD;
}

static inline void vslam_write_pose(const VslamPose* p, uint8_t record[VSLAM_POSE_BYTES]) {
  uint8_t* to = vslam_put_header(record, VSLAM_KIND_POSE, VSLAM_POSE_BYTES, p->sequence);
  to = vslam_put(to, p->flags, 4);
  to = vslam_put(to, p->state, 4);
  to = vslam_put(to, (uint64_t)p->stamp_ns, 8);
  to = vslam_put_doubles(to, p->position_m, 3);
  to = vslam_put_doubles(to, p->quaternion, 4);
  to = vslam_put_doubles(to, p->deviation, 6);
  to = vslam_put_doubles(to, p->observer_position_m, 3);
  to = vslam_put_doubles(to, p->observer_quaternion, 4);
  to = vslam_put(to, p->frames_dropped, 4);
  to = vslam_put(to, p->records_dropped, 4);
  vslam_put(to, p->landmarks, 4);
  vslam_put_crc(record, VSLAM_POSE_BYTES);
}

/* `pose` is written only when the answer is VSLAM_GOOD. */
static inline VslamFault vslam_read_pose(const uint8_t* record, size_t count, VslamPose* pose) {
  const VslamFault fault = vslam_check(record, count, VSLAM_KIND_POSE, VSLAM_POSE_BYTES);
  if (fault != VSLAM_GOOD) return fault;
  record = vslam_get_u32(record + 8, &pose->sequence);
  record = vslam_get_u32(record, &pose->flags);
  record = vslam_get_u32(record, &pose->state);
  record = vslam_get_i64(record, &pose->stamp_ns);
  record = vslam_get_doubles(record, pose->position_m, 3);
  record = vslam_get_doubles(record, pose->quaternion, 4);
  record = vslam_get_doubles(record, pose->deviation, 6);
  record = vslam_get_doubles(record, pose->observer_position_m, 3);
  record = vslam_get_doubles(record, pose->observer_quaternion, 4);
  record = vslam_get_u32(record, &pose->frames_dropped);
  record = vslam_get_u32(record, &pose->records_dropped);
  vslam_get_u32(record, &pose->landmarks);
  return VSLAM_GOOD;
}

#endif
