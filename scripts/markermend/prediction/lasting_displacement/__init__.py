"""Lasting displacements: from one moment on a marker sits elsewhere on its segment, whatever the pose.

The local position of the marker, in the frame of its neighbours, is regressed on the pose (the local positions of the
neighbours) and on the course of a displacement, together: like poses before and after are compared, and a change of pose
for good explains itself.
"""
