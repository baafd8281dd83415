"""Naive twins of the library's fast code: slow, obvious, and only for tests."""
