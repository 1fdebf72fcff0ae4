# SPDX-License-Identifier: BSD-3-Clause
"""What the thesis prints: tables 3.1-3.6, 4.1, 4.2, its chapter 7 and its appendices."""

# Tables 3.1-3.4: milliseconds and detected features of each picture.
DETECTORS = {
    "mandrill": {"FAST": (70, 16947), "SURF": (2100, 2245), "STAR": (600, 263), "MSER": (1000, 358), "GFTT": (400, 1000)},
    "peppers": {"FAST": (100, 2427), "SURF": (3400, 725), "STAR": (600, 136), "MSER": (900, 208), "GFTT": (400, 108)},
    "barbara": {"FAST": (70, 6995), "SURF": (1850, 985), "STAR": (600, 131), "MSER": (900, 268), "GFTT": (300, 964)},
    "lena": {"FAST": (40, 4743), "SURF": (1620, 687), "STAR": (600, 91), "MSER": (800, 110), "GFTT": (320, 308)},
}
# Table 3.5, the mean of the four: detected features, milliseconds a feature, tracking error in pixels.
DETECTORS_MEAN = {"FAST": (7778, 0.016, 2.7), "SURF": (1160.5, 2.465, 2.6), "STAR": (155.25, 4.438, 0.3), "MSER": (595, 4.445, 5.5), "GFTT": (355, 1.364, 4.0)}

# Table 3.6: megapixels a second, on 992x668 and on 352x288.
PIXEL_RATES = {"FAST9": (188, 179), "FAST12": (158, 154), "original FAST, s = 12": (79.0, 82.2), "FAST-ER": (75.4, 67.5)}

# Figure 3.11, from the text: share of the corners that 4 and 8 of 16 passes find.
SHARE_OF_4_PASSES, SHARE_OF_8_PASSES = 0.45, 0.75

# Table 4.1: milliseconds a feature according to three sources.
DESCRIPTORS = {"SIFT": (2.5, 5.29, 0.1746), "SURF": (1.4, 0.359, None), "BRISK": (0.031, 0.037, 0.0096),
               "FREAK": (0.018, None, 0.0091), "ORB": (None, None, 0.0146)}
# Table 4.2: milliseconds a frame and a feature.
FRONT_ENDS = {"SURF/BRISK": (434.1, 0.21), "SURF/FREAK": (290.6, 0.19), "SURF/SURF": (842.4, 0.34)}

LENS_MEAN_PX, LENS_SPEED_UP = 2.5, 22.6  # section 5.2.1
MEAN_DEVIATION_ERROR = 0.0921  # appendix C

KITTI_MEAN_M, KITTI_LARGEST_M, KITTI_LARGEST_OF_THREE_M = 0.158, 26, 0.65
KITTI_MATCHES_MODE, KITTI_MATCHES_MEAN, KITTI_LANDMARKS = 6, 11, 86358
DRONE_MATCHES_OF_LAPS = (5, 45, 80)
HOVER_DRIFT_M, HOVER_S = 2.0, 15.0
