# SPDX-License-Identifier: BSD-3-Clause
"""Section 5.2.1 and the appendices: lens correction and deviations."""

import numpy as np
from matplotlib.colors import LogNorm

from ardrone_vslam_evaluation.plot_style import TRUTH, panels, plt

import thesis
from section import Section, digits


def lens(tools):
    measured = tools.measure("lens")
    section = Section("Section 5.2.1: lens correction")
    by_key = {method["key"]: method for method in measured["methods"] if method["key"]}
    figure, axes = panels(3, 2.9, columns=3, sharey=True)
    shape = (-(-measured["height_px"] // measured["step_px"]), -(-measured["width_px"] // measured["step_px"]))
    for one, (key, title) in zip(axes, (("closed_form_3", "closed form, 3 terms"), ("closed_form_9", "closed form, 9 terms"), ("table", "table"))):
        errors = np.array(by_key[key]["map_px"], float).reshape(shape)
        shown = one.imshow(np.maximum(errors, 1e-10), norm=LogNorm(1e-10, 100), cmap="viridis", extent=(0, measured["width_px"], measured["height_px"], 0))
        one.set_title(f"{title}: mean {by_key[key]['mean_px']:.2g} px")
        one.set_xlabel("px")
        one.grid(False)
    figure.colorbar(shown, ax=axes, label="error [px]", shrink=0.8)
    section.picture("lens", figure, "Error over the image of the closed form and of the table")
    section.table(["way", "mean error [px]", "largest [px]", "time of a pixel [ns]"],
                  [[method["name"], digits(method["mean_px"], 2), digits(method["largest_px"], 2), digits(method["time_ns"], 2)] for method in measured["methods"]])
    closed = by_key["closed_form_3"]
    exact = next(method for method in measured["methods"] if method["name"].startswith("`exact`"))
    opencv = next(method for method in measured["methods"] if method["name"].startswith("cv::undistortPoints until"))
    own_closed = next(method for method in measured["methods"] if method["name"].startswith("`closed_form`"))
    section.text(f"The thesis: {thesis.LENS_MEAN_PX} px mean error on 640x360, {thesis.LENS_SPEED_UP} times as fast as the iterative inverse (Matlab). Here, with the AR.Drone's "
                 f"camera of the data (f = {measured['f_px']:g} px, k1 = {measured['k1']:g}, k2 = {measured['k2']:g}): {digits(closed['mean_px'], 2)} px. It is "
                 f"{digits(exact['time_ns'] / own_closed['time_ns'], 2)} times as fast as our Newton's method, {digits(opencv['time_ns'] / own_closed['time_ns'], 2)} times as fast as "
                 "OpenCV's iteration to the same accuracy. The thesis prints no calibration; its mean is reached where the sensor sees 4 degrees more of this lens. The "
                 "table is exact and no slower. More on this: [lens_correction.md](lens_correction.md).")
    table = by_key["table"]
    section.claim("mean error of the closed form with 3 terms [px]", closed["mean_px"], 0.3, 0.5)
    section.claim("mean error of the table [px]", table["mean_px"], high=0.01)
    section.claim("largest error of the table [px]", table["largest_px"], high=0.01)
    plt.close("all")
    return section


def mean_deviation(tools):
    measured = tools.measure("mean_deviation")
    section = Section("Appendix C: the deviation of the weighted mean")
    points = measured["against_landmarks"]
    figure, (axes,) = panels(1, 3.6)
    counts = [point["landmarks"] for point in points]
    for key, label, colour in (("error_conventional_m", "(C.1) with weights 1 / sigma", "#ff7f0e"), ("error_printed_m", "(6.5), the fitted weights", "#d62728"),
                               ("error_reduced_m", "(C.2)", "#9467bd"),
                               ("error_mended_m", "(6.5) with W = (sum w)^2", "#2ca02c"), ("error_exact_m", "sqrt(N) / sum(1 / sigma), this package", "#1f77b4")):
        axes.plot(counts, [point[key] for point in points], "o-", markersize=4, label=label, color=colour)
    axes.plot(counts, [point["sigma_m"] for point in points], "--", color=TRUTH, label="the true deviation itself")
    axes.set_yscale("log")
    axes.set_xlabel("landmarks")
    axes.set_ylabel("error of the deviation [m]")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1))
    section.picture("mean_deviation", figure, "Error of the deviation's formulas against the number of landmarks")
    mean = {key: float(np.mean([point[f"error_{key}_m"] for point in points])) for key in ("printed", "conventional", "reduced", "mended", "exact")}
    section.table(["mean error of the deviation [m]", "thesis", "here"], [
        ["(6.5) with the fitted weights 0.2613 sigma^-0.7642", str(thesis.MEAN_DEVIATION_ERROR), digits(mean["printed"])],
        ["(C.1) with weights 1 / sigma, as its text says", "about ten times as much (figure C.1)", digits(mean["conventional"])],
        ["(C.2), which the thesis makes of it: N / sum(w)", "-", digits(mean["reduced"])],
        ["(6.5) with the fitted weights and W = (sum w)^2", "-", digits(mean["mended"])],
        ["sqrt(N) / sum(1 / sigma)", "-", digits(mean["exact"], 2)]])
    section.text(f"{measured['inputs']} random inputs for each number of landmarks, deviations even between 0.01 and 1 m, each against the scatter of {measured['runs']} means (6.4). As "
                 "printed, with W the sum of the squares, the fitted factor cancels out of (6.5). What is left does not shrink with the number of landmarks, as the true deviation does. "
                 "With W the square of the sum the same fit is about nine times better than (C.1): the \"ten-fold\" of the text. So that is probably what was computed, and (6.5) is "
                 "misprinted. (C.2) is not what (C.1) becomes with "
                 "these weights. For independent inputs the last formula is exact, and its error here is that of the simulation.")
    wrong = measured["wrong_observer"]
    section.text("The inputs are not independent, though: each position contains the observer's own error along its ray. 50 landmarks in 80 x 52 degrees, the observer half a metre off "
                 "along the optical axis:")
    section.table(["`mean`", "error left [m]", "deviation claimed [m]"], [[name, digits(wrong[name]["error_m"]), digits(wrong[name]["claimed_m"], 2)] for name in ("printed", "exact")])
    section.claim("error of (6.5) over that of (C.1)", mean["printed"] / mean["conventional"], 1.2, 2)
    section.claim("error of (6.5) with W = (sum w)^2 over that of (C.1)", mean["mended"] / mean["conventional"], 0.05, 0.2)
    section.claim("error of the exact formula over that of (C.1)", mean["exact"] / mean["conventional"], high=0.02)
    section.claim("error that the printed mean leaves of 0.5 m", wrong["printed"]["error_m"], 0.37, 0.45)
    section.claim("error that the exact mean leaves [m]", wrong["exact"]["error_m"], high=0.01)
    plt.close("all")
    return section


def landmark_sigma(tools):
    measured = tools.measure("landmark_sigma")
    section = Section("Appendix D: where a landmark's error lies")
    angles = measured["angles"]
    clouds, axes = panels(len(angles), 2.9, columns=4)
    for one, angle in zip(axes, angles):
        points = np.array(angle["cloud"])
        one.plot(points[:, 0], points[:, 1], ".", color="#333333", markersize=2, rasterized=True)
        turn = np.linspace(0, 2 * np.pi, 90)
        x, y, z = angle["sigma_m"]
        for radius, colour, label in ((3 * np.sqrt((x * x + y * y + z * z) / 3), "#888888", "mean of x, y, z"), (3 * np.sqrt((x * x + z * z) / 2), "#d62728", "mean of x, z"),
                                      (3 * angle["formula_m"], "#2ca02c", "(D.1)")):
            one.plot(radius * np.cos(turn), radius * np.sin(turn), color=colour, label=label)
        one.set_aspect("equal", adjustable="datalim")
        one.set_title(f"theta = {angle['theta_deg']:g} degrees")
        one.set_xlabel("x [m]")
    axes[0].set_ylabel("y, away from the positions [m]")
    axes[-1].legend(fontsize=7, title="3 deviations", title_fontsize=7, loc="upper right")
    section.picture("landmark_clouds", clouds, "Landmark errors from above, with three deviations of each formula (figure D.2)")
    images, axes = panels(len(angles), 2.9, columns=4)
    for one, angle in zip(axes, angles):
        points = 1e3 * np.array(angle["cloud"])
        one.plot(points[:, 3], points[:, 4], ".", color="#333333", markersize=2, rasterized=True)
        one.set_aspect("equal", adjustable="datalim")
        one.set_title(f"theta = {angle['theta_deg']:g} degrees")
        one.set_xlabel("x / y [1/1000]")
    axes[0].set_ylabel("z / y [1/1000]")
    section.picture("landmark_images", images, "The same on the image plane of the present position (figure D.3)")
    section.table(["theta, parallax [deg]", "distance [m]", "deviation x, y, z [m]", "across the ray [m]", "along it [m]", "(D.1) [m]", "(D.1) over the sine of the parallax"],
                  [[f"{angle['theta_deg']:g}, {angle['parallax_deg']:g}", digits(angle["depth_m"]), ", ".join(digits(value, 2) for value in angle["sigma_m"]),
                    digits(angle["across_m"], 2), digits(angle["along_m"], 2), digits(angle["formula_m"], 2), digits(angle["formula_along_m"], 2)] for angle in angles])
    section.text(f"{measured['runs']} drawings of table D.1 each; the thesis prints neither its four angles nor numbers. Its shapes are found again: a ball at 45 degrees, and an "
                 "ellipsoid along y that grows as theta shrinks. On the image plane it is a round cloud for the smaller angles. (D.1) tells the error across the ray. The text says that "
                 "it lies between both projections. At 45 degrees it is a little above them, at the others between them. Of the depth it says nothing: at 2 degrees of parallax the landmark is off along the ray by some thirty times what it says. The package keeps "
                 "the depth's deviation beside it, (D.1) over the sine of the parallax (`depthSigma_m`): the last column.")
    least = angles[-1]
    section.claim("error along the ray over (D.1) at 2 degrees of parallax", least["along_m"] / least["formula_m"], 25, 40)
    section.claim("the same over this package's deviation of the depth", least["along_m"] / least["formula_along_m"], 0.9, 1.3)
    section.claim("error across the ray over (D.1), largest of the angles", max(angle["across_m"] / angle["formula_m"] for angle in angles), 0.8, 1.05)
    section.claim("deviation z over x at 45 degrees (a ball)", angles[0]["sigma_m"][2] / angles[0]["sigma_m"][0], 0.9, 1.1)
    plt.close("all")
    return section
