# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 3: corner detectors, FAST and its sampling passes."""

import numpy as np

from ardrone_vslam_evaluation.plot_style import panels, plt

import thesis
from section import Section, digits, percent

OURS = "FAST-12 (this package)"


def _detector_rows(measured, picture, stand_ins):
    printed = thesis.DETECTORS.get(picture, {})
    rows = []
    for name, numbers in measured["pictures"][picture].items():
        time_ms, count = printed.get(stand_ins[name], (None, None))
        is_own = stand_ins[name] in name
        rows.append([name if is_own else f"{name}, for {stand_ins[name]}", "-" if count is None else f"{count:,}", f"{numbers['count']:,.0f}",
                     "-" if count is None else digits(1e3 * time_ms / count), digits(1e3 * numbers["time_ms"] / max(numbers["count"], 1))])
    return rows


def _mean_row(measured, detector):
    count, time_ms, error_px = thesis.DETECTORS_MEAN[detector["stands_for"]]
    here = [picture[detector["name"]] for picture in measured["pictures"].values()]
    return [detector["name"], f"{count:,.0f}", f"{np.mean([one['count'] for one in here]):,.0f}", digits(1e3 * time_ms),
            digits(1e3 * np.mean([one["time_ms"] / max(one["count"], 1) for one in here])), digits(error_px, 2), digits(detector["tracking_error_px"], 2)]


def detectors(tools):
    measured = tools.measure("detectors")
    section = Section("Tables 3.1 to 3.5: detectors")
    stand_ins = {one["name"]: one["stands_for"] for one in measured["detectors"]}
    section.text("The thesis quotes a comparison of OpenCV's detectors on four pictures of 512x512. Debian's OpenCV has neither SURF nor STAR: SIFT stands in for SURF, as both look for "
                 "blobs over a scale space. AKAZE stands in for STAR, as both compute their scales in the full size. Barbara is not at hand"
                 + ("." if tools.data else ", nor are the others here: rendered views stand in for all four."))
    for picture in measured["pictures"]:
        section.text(f"**{picture}**")
        section.table(["detector", "thesis: features", "here", "thesis: us a feature", "here"], _detector_rows(measured, picture, stand_ins))
    section.text("**Means of the pictures** (table 3.5; the thesis's contain Barbara). Tracking error: how far points are off that `cv::calcOpticalFlowPyrLK` follows "
                 "into the picture turned by 4 degrees, the 500 strongest of each detector. The thesis's source does not say over what motion it measured.")
    section.table(["detector", "thesis: features", "here", "thesis: us a feature", "here", "thesis: tracking error [px]", "here"],
                  [_mean_row(measured, one) for one in measured["detectors"]])
    section.text(f"Why they differ: the machine is some {_median_speed_up(measured)} times as fast as the source's, which prints no thresholds. "
                 f"Here `cv::FAST` is shown without suppression, at {measured['fast_threshold']} grey levels, " +
                 ("where it finds the thesis's number in mandrill but fewer in the others. So the source's thresholds differed from picture to picture. "
                  if "mandrill" in measured["pictures"] else "OpenCV's usual threshold less or more. ") +
                 "This package's corners have passed the suppression, at a threshold of 35. The conclusion stands: FAST is the fastest, a feature at a fifth of the next one's "
                 "time or less.")
    section.text("Printed for Barbara (table 3.3): " + ", ".join(f"{name} {time_ms} ms, {count:,} features" for name, (time_ms, count) in thesis.DETECTORS["barbara"].items()) + ".")
    errors = {one["name"]: one["tracking_error_px"] for one in measured["detectors"]}
    # Bounds here and below: within 1.2 times what was measured on real and on rendered pictures, in quick and in whole runs. Here 0.20 to 0.31, and 142 to 1140.
    section.claim("tracking error of FAST-12 [px]", errors[OURS], high=0.37)
    section.claim("corners of FAST-12 in the picture with the fewest", min(one[OURS]["count"] for one in measured["pictures"].values()), low=118)
    return section


def _median_speed_up(measured):
    """Of what both measured, a picture."""
    ratios = [printed[name][0] / measured["pictures"][picture]["cv::" + name]["time_ms"]
              for picture, printed in thesis.DETECTORS.items() if picture in measured["pictures"] for name in ("MSER", "GFTT")]
    return digits(float(np.median(ratios)), 2) if ratios else "tens of"


def repeatability(tools):
    measured = tools.measure("repeatability")
    section = Section("Figure 3.3: repeatability of FAST-s")
    figure, axes = panels(2, 3.6, sharey=True)
    for one, noise in zip(axes, (0, measured["noise_grey"])):
        for budget in sorted({point["budget"] for point in measured["points"]}):
            points = [p for p in measured["points"] if p["budget"] == budget and p["noise_grey"] == noise]
            one.plot([p["s"] for p in points], [p["repeatability"] for p in points], "o-", markersize=4, label=f"{budget} strongest corners")
        one.set_title(f"noise of {noise:g} grey levels" if noise else "no noise")
        one.set_xlabel("s of FAST-s")
    axes[0].set_ylim(0, 1)
    axes[0].set_ylabel("repeatability")
    axes[0].legend()
    section.picture("repeatability", figure, "Repeatability against s")
    at = {(p["s"], p["noise_grey"], p["budget"]): p["repeatability"] for p in measured["points"]}
    noise = measured["noise_grey"]
    section.text(f"Measured on {measured['what']}. A corner counts as repeated when the other picture has one within 2 px of where the truth puts it. The thesis "
                 "copies Rosten's curves (the smaller s, the better) and does not print numbers. Found again: at a noise of 12 the 500 strongest corners "
                 f"repeat to {percent(at[9, noise, 500])} with s = 9, {percent(at[12, noise, 500])} with 12 and {percent(at[16, noise, 500])} with 16. FAST-9 repeats better than the "
                 "thesis's FAST-12. That is the default all the same: it takes less time.")
    # Measured: 0.70 to 0.76, 0.75 to 0.77, 0.24 to 0.47.
    section.claim("repeatability at noise 12, 500 corners, s = 9", at[9, noise, 500], 0.65, 0.82)
    section.claim("the same of s = 12, over s = 9", at[12, noise, 500] / at[9, noise, 500], 0.7, 0.83)
    section.claim("the same of s = 16, over s = 12", at[16, noise, 500] / at[12, noise, 500], 0.2, 0.56)
    return section


def corner_speed(tools):
    measured = tools.measure("corner_speed")
    section = Section("Table 3.6, figures 3.6 to 3.8: what FAST costs")
    section.text("Megapixels a second, suppression included. The thesis's are Rosten's on a 3 GHz Pentium 4; FAST-ER is not in Debian, AGAST, also a tree "
                 "that was learnt, stands in.")
    rows = [[name, digits(values[0]), digits(values[1])] for name, values in thesis.PIXEL_RATES.items()]
    section.table(["printed", "992x668", "352x288"], rows)
    large, small = measured["sizes"]["992x668"], measured["sizes"]["352x288"]
    section.table(["here", "992x668", "352x288", "corners"],
                  [[a["name"], digits(a["mpx_per_s_time"]), digits(b["mpx_per_s_time"]), f"{a['corners']:.0f}, {b['corners']:.0f}"]
                   for a, b in zip(large, small)])
    figure, (axes,) = panels(1, 3.8)
    for name, points in measured["against_corners"].items():
        axes.plot([p["corners"] for p in points], [p["time_ms"] for p in points], "o-", markersize=4, label=name)
    axes.set_yscale("log")
    axes.set_xlabel("corners found, before suppression")
    axes.set_ylabel("time of an image of 320x240 [ms]")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1))
    section.picture("corner_speed", figure, "Time of FAST against the number of corners")
    section.text("Figures 3.6 to 3.8 were measured on the drone. There Rosten's FAST of 2000 lines of if and else took more than 33 ms, and the thesis's compact form half of that. Here the compact form is `kernels/fast/fast_scalar.cpp` (initial test, order (3.3)), each pixel alone. It is what a DSP without vector instructions "
                 "would run. `cv::FAST`, which descends from Rosten's, and this package's own default (table above) have vector instructions. That is a different class. As printed, fewer corners cost less time. "
                 "For the same image and threshold, s = 12 costs less than s = 9 where there are many corners. Where there are few it costs a little more. Three of the four first "
                 "pixels have to be looked at then, while for s = 9 two neighbours decide. \"By definition\" looks at all arcs of every pixel, the naive way, and takes the same time "
                 "whatever it finds. It stands for the lack of an initial test. The \"original FAST\" is another one: in print it is half as fast as FAST-12.")
    by_name = {one["name"]: one["corners"] for one in small}
    section.claim("corners of FAST-12 over those by definition", by_name[OURS] / by_name["FAST-12 by definition, no initial test"], 1, 1)
    section.claim("corners of FAST-9 over cv::FAST's", by_name["FAST-9 (this package)"] / by_name["cv::FAST 9_16"], 1, 1)
    return section


def sampling(tools):
    measured = tools.measure("sampling")
    section = Section("Figures 3.11 to 3.13: sampling passes")
    passes = np.arange(1, 17)
    figure, axes = panels(3, 3.4, columns=3)
    share = {}
    for form, label, colour in (("scalar", "a pixel at a time", "#1f77b4"), ("vector", "vector instructions", "#ff7f0e")):
        corners = np.array([p["corners"] for p in measured[form]])
        time_ms = np.array([p["time_ms"] for p in measured[form]])
        share[form] = corners / corners[-1]
        axes[1].plot(passes, 100 * time_ms / time_ms[-1], "o-", markersize=3, label=label, color=colour)
        axes[2].plot(passes, corners / time_ms / 1e3, "o-", markersize=3, label=label, color=colour)
    axes[0].plot(passes, 100 * share["scalar"], "o-", markersize=3, label="here")
    axes[0].plot([4, 8, 16], [100 * thesis.SHARE_OF_4_PASSES, 100 * thesis.SHARE_OF_8_PASSES, 100], "x", color="#d62728", markersize=8, label="thesis's text")
    for one, label in zip(axes, ("corners found [%]", "time [% of 16 passes]", "corners a microsecond")):
        one.set_xlabel("passes")
        one.set_ylabel(label)
        one.set_ylim(bottom=0)
        one.legend()
    section.picture("sampling", figure, "Corners found, time and corners a microsecond against the sampling passes")
    section.text(f"Measured on {measured['frames']} frames of 320x240 ({measured['what']}), FAST-12, threshold {measured['threshold']}.")
    section.table(["", "thesis", "here"], [["corners that 4 of 16 passes find", percent(thesis.SHARE_OF_4_PASSES), percent(share["scalar"][3])],
                                           ["8 passes", percent(thesis.SHARE_OF_8_PASSES), percent(share["scalar"][7])]])
    scalar = measured["scalar"]
    gain = scalar[3]["corners"] / scalar[3]["time_ms"] * scalar[15]["time_ms"] / scalar[15]["corners"]
    section.text("The share is found again. The gain in speed of figure 3.13, nearly twice the corners a second with 4 passes, is found in part. A pixel at a time, 4 passes take "
                 f"{percent(scalar[3]['time_ms'] / scalar[15]['time_ms'])} of the time, which are {digits(gain)} times the corners a second. That is on these images; "
                 "on KITTI's larger ones there is hardly any ([front_end.md](front_end.md#sampling-passes)). 16 passes are cheaper than 15, as all pixels are tested and no climb has to ask for "
                 "scores. With vector instructions leaving pixels out gains nothing at all. Hence 16 passes by default.")
    # Measured: 0.50 to 0.62, 0.77 to 0.84.
    section.claim("share of the corners that 4 passes find", share["scalar"][3], 0.46, 0.66)
    section.claim("share that 8 passes find", share["scalar"][7], 0.73, 0.87)
    section.claim("largest difference between the scalar form's corners and the vector form's", float(np.abs(share["scalar"] - share["vector"]).max()), 0, 0)
    plt.close("all")
    return section
