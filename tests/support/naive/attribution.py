"""The attribution of events to markers, restated word by word with sets of samples and loops."""

from dataclasses import replace

import numpy as np

from markermend.core.events import Event


def displaced_runs(residual, recorded, name, *, level):
    """Runs of frames in which the smaller of residual and trajectory exceeds a level; the largest is the score."""
    size = [min(a, b) if a == a and b == b else 0.0 for a, b in zip(residual, recorded, strict=True)]
    found, start = [], None
    for frame, value in enumerate([*size, 0.0]):
        if value > level and start is None:
            start = frame
        elif value <= level and start is not None:
            found.append(Event(name, start, frame, float(max(size[start:frame])), "x"))
            start = None
    return found


def samples(events, detector, *, border=0):
    """The samples (frame, marker) of events, and some on either side."""
    frames = len(detector.scene.positions)
    return {
        (frame, detector.markers.index(event.marker))
        for event in events
        for frame in range(max(event.start - border, 0), min(event.stop + border, frames))
    }


def predicted(detector, predictor, hidden):
    """The residual of each marker, alone as recorded among the others without their hidden samples."""
    scene = detector.scene
    residual = np.full(scene.positions.shape, np.nan)
    for m in range(len(detector.markers)):
        positions = scene.positions.copy()
        for frame, other in hidden:
            if other != m:
                positions[frame, other] = np.nan
        residual[:, m] = predictor.residuals(replace(scene, positions=positions), [m])[:, m]
    return residual


def share(one, other):
    return bool(set(range(one.start, one.stop)) & set(range(other.start, other.stop)))


def hide(detector, predictor, candidates):
    """Hide candidates, but for those for whose sake a residual would be lost; start again until none is."""
    hidden = samples(candidates, detector, border=detector.border)
    residual, complete = predicted(detector, predictor, hidden), predicted(detector, predictor, set())
    scene, needed = detector.scene, set()
    for m, around in enumerate(scene.neighbours):
        beside = {frame for frame, other in hidden if other in around}
        lost = {
            frame
            for frame in range(len(scene.positions))
            if np.isnan(residual[frame, m]).any()
            and not np.isnan(complete[frame, m]).any()
            and scene.present[frame, m]
            and ((frame, m) in hidden or frame not in beside)
        }
        places = lost & beside if lost & beside else set(range(len(scene.positions))) if lost else set()
        needed |= {(frame, int(other)) for frame in places for other in around}
    kept = [event for event in candidates if not samples([event], detector, border=detector.border) & needed]
    return (hidden, residual) if len(kept) == len(candidates) else hide(detector, predictor, kept)


def attribute(detector, predictor, *, rounds, reach):
    """Find the events of all markers, sorted."""
    count = len(detector.markers)
    near = [set(map(int, own[:reach])) for own in detector.scene.neighbours]
    neighbours = [{n for n in range(count) if n in near[m] or m in near[n]} for m in range(count)]

    def of(event):
        return detector.markers.index(event.marker)

    def compete(one, other):
        return of(other) in neighbours[of(one)] and share(one, other)

    candidates = [event for m in range(count) for event in detector.find_candidates(detector.scene.positions, m)]
    contested = [one for one in candidates if any(compete(one, other) for other in candidates)]
    hidden, residual = hide(detector, predictor, contested)
    found = [detector.find_events(residual, m) for m in range(count)]
    accepted = [event for own in found for event in own if samples([event], detector) <= hidden]
    again_later = set()
    for _ in range(rounds):
        open_ones = sorted(
            (event for own in found for event in own if event not in accepted),
            key=lambda event: (-event.score, event.order),
        )
        strongest = []
        for event in open_ones:
            if not any(compete(event, other) for other in strongest):
                strongest.append(event)
        accepted += strongest
        again = {of(event) for event in open_ones if event not in strongest}
        for m in range(count):
            beside = [event for event in strongest if of(event) in neighbours[m]]
            borders = {frame for event in beside for frame in (event.start, event.stop)}
            if borders & set(detector.unexplained(residual, m)):
                again_later.add(m)
            if beside and m in again_later:
                again.add(m)
        again_later |= again
        if not again:
            break
        hidden = hidden | samples(strongest, detector, border=detector.border)
        anew = predicted(detector, predictor, hidden)
        for m in again:
            residual[:, m] = anew[:, m]
        for m in again:
            kept = [event for event in found[m] if event in accepted]
            judged = [
                event for event in detector.find_events(residual, m) if not any(share(event, own) for own in kept)
            ]
            found[m] = kept + judged
    return sorted((event for own in found for event in own), key=lambda event: event.order)
