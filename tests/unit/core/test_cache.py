"""The cache: a result is computed once while it is among the last."""

from markermend.core.cache import Cache


def test_a_result_is_computed_once_and_the_oldest_is_dropped():
    cache, computed = Cache(2), []

    def ask(key):
        return cache.get(key, lambda: computed.append(key) or f"result {key}")

    assert [ask(key) for key in (1, 2, 1)] == ["result 1", "result 2", "result 1"]
    ask(3)
    ask(2)
    ask(1)
    assert computed == [1, 2, 3, 1]
