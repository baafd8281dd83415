"""Former keys of the config, so that an old one is refused with its new name."""

from __future__ import annotations

RENAMED: dict[str, tuple[str, dict[str, str]]] = {
    "swaps": (
        "labels",
        {
            "ratio": "max_remaining_fraction",
            "jump": "jump_factor",
            "near": "shape_neighbours",
            "trust": "recorded_label_weight",
            "clear": "min_clearness",
        },
    ),
    "frozen": ("frozen", {"frames": "min_frames", "sigmas": "threshold_sigmas"}),
    "tails": (
        "tails",
        {
            "longest_s": "max_duration_s",
            "before_s": "min_seen_before_s",
            "activity_s": "scale_window_s",
            "changes": "onset_factor",
            "sigmas": "threshold_sigmas",
            "weak": "half_fraction",
        },
    ),
    "peaks.default": (
        "peaks",
        {
            "order": "polynomial_order",
            "shrinkage": "white_noise_ratio",
            "windows": "covariance_windows",
            "activity_s": "scale_window_s",
            "activity_ratio": "max_scale_ratio",
            "activity_neighbours": "scale_neighbours",
            "sigmas": "threshold_sigmas",
            "rounds": "attribution_rounds",
            "rivals": "attribution_neighbours",
            "longest_s": "max_duration_s",
            "weak": "extent_fraction",
            "edge": "max_shift_ratio",
        },
    ),
    "peaks.coordinates": (
        "peaks.coordinates",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "longest_s": "max_duration_s",
            "trend": "trend_removal",
            "balance": "balance_ratio",
        },
    ),
    "peaks.paper": (
        "peaks.paper",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "longest_s": "max_duration_s",
            "trend": "trend_removal",
            "balance": "balance_ratio",
        },
    ),
    "noise.default": (
        "noise",
        {
            "window_s": "median_window_s",
            "activity_s": "scale_window_s",
            "activity_ratio": "max_scale_ratio",
            "activity_neighbours": "scale_neighbours",
            "sigmas": "threshold_sigmas",
            "tails": "tail_factor",
            "rounds": "attribution_rounds",
            "rivals": "attribution_neighbours",
            "shortest_s": "min_duration_s",
            "density": "min_sudden_share",
            "minimum_changes": "min_sudden_changes",
        },
    ),
    "noise.coordinates": (
        "noise.coordinates",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "order": "polynomial_order",
            "shortest_s": "min_duration_s",
            "density": "min_sudden_share",
            "minimum_changes": "min_sudden_changes",
        },
    ),
    "noise.paper": (
        "noise.paper",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "order": "polynomial_order",
            "shortest_s": "min_duration_s",
            "density": "min_sudden_share",
            "minimum_changes": "min_sudden_changes",
        },
    ),
    "steps": (
        "steps",
        {
            "correlation_time_s": "level.correlation_time_s",
            "remaining_fractions": "level.remaining_fractions",
            "min_shape_deviation_mm": "level.min_shape_deviation_mm",
            "similar_poses": "level.similar_poses",
        },
    ),
    "steps.default": (
        "steps",
        {
            "order": "polynomial_order",
            "shrinkage": "white_noise_ratio",
            "windows": "covariance_windows",
            "activity_s": "scale_window_s",
            "activity_ratio": "max_scale_ratio",
            "activity_neighbours": "scale_neighbours",
            "sigmas": "threshold_sigmas",
            "rounds": "attribution_rounds",
            "rivals": "attribution_neighbours",
            "shortest_s": "min_duration_s",
            "longest_s": "max_duration_s",
            "ratio": "jump_mismatch_fraction",
            "cosine": "jump_mismatch_fraction",
            "held": "min_probability",
            "alike": "jump_mismatch_fraction",
            "weak": "single_jump_fraction",
            "joint": "joint_jump_fraction",
            "whole": "min_probability",
            "level_s": "level_window_s",
            "cut": "min_probability",
            "sure": "recording_end_factor",
        },
    ),
    "steps.coordinates": (
        "steps.coordinates",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "order": "polynomial_order",
            "longest_s": "max_duration_s",
            "shortest_s": "min_duration_s",
            "ratio": "min_jump_ratio",
        },
    ),
    "steps.paper": (
        "steps.paper",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "order": "polynomial_order",
            "longest_s": "max_duration_s",
            "shortest_s": "min_duration_s",
            "ratio": "min_jump_ratio",
        },
    ),
    "slow.default": (
        "slow",
        {
            "ridge": "local_ridge_changes",
            "lengths_s": "durations_s",
            "flank": "flank_fraction",
            "taps": "samples_per_duration",
            "scales_s": "correlation_times_s",
            "longest_s": "max_lag_s",
            "clip_sigmas": "outlier_sigmas",
            "blocks": "leverage_blocks",
            "neighbours": "scale_neighbours",
            "sigmas": "threshold_sigmas",
            "noise_mm": "high_scale_mm",
            "sure": "high_scale_factor",
            "least": "min_scale_sigmas",
            "apart": "distinct_factor",
            "plain": "obvious_factor",
            "rest": "max_baseline_fraction",
            "shortest_s": "min_duration_s",
            "brief_s": "bridged_gap_s",
            "rivals": "attribution_neighbours",
            "suspect": "suspect_fraction",
            "kept": "remaining_fraction",
        },
    ),
    "slow.paper": (
        "slow.paper",
        {
            "scale": "scale_estimator",
            "sigmas": "threshold_sigmas",
            "bridge_s": "slope_window_s",
            "order": "polynomial_order",
            "shortest_s": "min_duration_s",
            "smooth_s": "smoothing_window_s",
            "lower": "lower_sigmas",
            "top_s": "min_upper_duration_s",
        },
    ),
    "mesh": (
        "mesh",
        {
            "frames": "max_frames",
            "valid_frames": "min_frames",
            "scale_mm": "reference_distance_mm",
            "cut_mm": "segment_cut_mm",
            "component_cost": "max_edge_cost_mm",
            "minimum_predictors": "min_predictors",
            "neighbours": "max_neighbours",
            "excitation_s": "min_excitation_s",
            "excitation_sigma_mm": "min_excitation_mm",
            "segments_ratio": "max_markers_per_segment",
            "marker_overlap": "min_marker_overlap",
        },
    ),
    "repair": (
        "repair",
        {"prefer": "preference_factor", "savitzky_golay_s": "savitzky_golay_window_s", "trials": "hidden_stretches"},
    ),
    "repair.separation": (
        "repair.separation",
        {
            "ridges": "local_ridge_changes",
            "margins": "margin_fractions",
            "trust": "likelihood_power",
            "most_frames": "max_frames",
        },
    ),
    "fill": (
        "fill",
        {
            "ends": "fill_ends",
            "seen_share": "min_seen_share",
            "reuse": "reuse_filled",
            "variants": "predictors.local_ridge_variants",
        },
    ),
    "fill.ensemble": (
        "fill.ensemble",
        {
            "longest_s": "max_gap_s_of_member",
            "fallback": "fallback_members",
            "power": "error_power",
            "hidden_share": "max_hidden_share",
            "similar_length": "max_length_ratio",
            "similar_neighbours": "compared_neighbours",
            "most_sorts": "max_gap_kinds",
            "worst": "max_error_ratio",
            "error_mm": "min_error_mm",
            "prior": "stated_error_weight",
        },
    ),
    "fill.ensemble.distances": (
        "fill.ensemble.distances",
        {
            "minimum_frames": "min_frames",
            "frames": "max_frames",
            "floor": "min_likelihood",
            "spacing_low": "spacing_lower_quantile",
            "spacing_high": "spacing_upper_quantile",
        },
    ),
    "fill.ensemble.radius": ("fill.ensemble.radius", {"trials": "prior_pseudo_gaps"}),
    "local_ridge": (
        "predictors.local_ridge",
        {
            "width_mm": "min_anchor_extent_mm",
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "robust_sigmas": "outlier_sigmas",
            "scales_s": "correlation_times_s",
            "longest_s": "max_lag_s",
            "novelty": "max_leverage",
        },
    ),
    "interpolation": ("predictors.interpolation", {}),
    "polynomial": (
        "predictors.polynomial",
        {
            "nearest": "neighbours",
            "lag_s": "lag_interval_s",
            "powers": "max_power",
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
        },
    ),
    "replicated_network": (
        "predictors.replicated_network",
        {
            "nearest": "neighbours",
            "lag_s": "lag_interval_s",
            "powers": "max_power",
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
            "average_s": "moving_average_s",
            "hidden": "hidden_units",
            "held_out": "validation_share",
            "iterations": "max_iterations",
            "rest": "gradient_tolerance",
            "probe": "curvature_step",
        },
    ),
    "fill.linear_regression": (
        "predictors.linear_regression",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "deviation_mm": "max_distance_deviation_mm",
            "minimum_inputs": "min_inputs",
        },
    ),
    "fill.reference_frame": (
        "predictors.reference_triangle",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "height_mm": "min_height_mm",
            "smoothness": "kernel_width_sigmas",
        },
    ),
    "fill.msvd": (
        "predictors.msvd",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
            "shrinkage": "shrink_singular_values",
            "explained": "explained_variance",
            "iterations": "max_iterations",
        },
    ),
    "fill.weighted_pca": (
        "predictors.weighted_pca",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
            "minimum_inputs": "min_inputs",
            "scale_mm": "weight_width_mm",
            "distal": "max_distance_ratio",
            "explained": "explained_singular_values",
        },
    ),
    "fill.kalman": (
        "predictors.kalman",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
            "explained": "explained_variance",
            "components": "max_components",
            "noise_mm": "min_noise_mm",
        },
    ),
    "fill.bolero": (
        "predictors.bolero",
        {
            "hidden": "state_dimensions",
            "minimum_frames": "min_training_frames",
            "iterations": "max_iterations",
            "floor_share": "min_deviation_share",
            "frames": "max_bone_frames",
            "steps": "max_bone_steps",
        },
    ),
    "fill.local_gp": (
        "predictors.local_gp",
        {
            "points": "inducing_points",
            "lengths": "length_scale",
            "amplitudes": "penalty",
        },
    ),
    "fill.networks": (
        "predictors.neural_networks",
        {
            "frames": "max_training_frames",
            "minimum_frames": "min_training_frames",
            "share": "min_joint_share",
            "minimum_inputs": "min_inputs",
            "units": "dense_units",
            "stretch_s": "max_sequence_s",
            "trial_epochs": "pseudo_gap_epochs",
            "drop": "learning_rate_factor",
            "drop_every": "learning_rate_epochs",
            "clip": "max_gradient_norm",
            "batch": "batch_networks",
        },
    ),
    "qc": ("qc", {"plot_frames": "max_plot_frames"}),
}
"""For each former section: where its options are now, and which of their names changed.

A new name with a full stop names its section, too. The tier of an option follows from its declaration.
"""


def renamed(path: str) -> str | None:
    """Name the option that a former key stands for.

    Parameters
    ----------
    path : str
        The keys that led to it, such as `steps.default.alike`.

    Returns
    -------
    str or None
        Section and name of the option, such as `steps.jump_mismatch_fraction`; None for a key that there never was.
    """
    section, _, key = path.rpartition(".")
    if section not in RENAMED:
        return None
    now, names = RENAMED[section]
    name = names.get(key, key)
    return name if "." in name else f"{now}.{name}"
