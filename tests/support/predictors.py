"""Predictors for tests that are simple enough to compute by hand."""

import numpy as np


class MeanOfOthers:
    """Predicts each marker as the mean of its observed neighbours."""

    def residuals(self, scene, markers=None):
        out = np.full(scene.positions.shape, np.nan)
        for m in range(len(scene.neighbours)) if markers is None else markers:
            others = scene.positions[:, scene.neighbours[m]]
            seen = ~np.isnan(others[:, :, 0])
            alone = seen.sum(axis=1) == 0
            out[:, m] = scene.positions[:, m] - np.nansum(others, axis=1) / np.maximum(seen.sum(axis=1), 1)[:, None]
            out[alone, m] = np.nan
        return out


class NeedsFrames(MeanOfOthers):
    """Predicts no marker at all unless all of its neighbours are observed in most frames."""

    def residuals(self, scene, markers=None):
        out = super().residuals(scene, markers)
        for m, near in enumerate(scene.neighbours):
            if scene.present[:, near].all(axis=1).mean() < 0.9:
                out[:, m] = np.nan
        return out
