"""Stages at the same time: the order, the errors and the memory of stages in turn."""

from __future__ import annotations

import signal
import threading
import time

import pytest

from pbfluids import pipeline


@pytest.fixture
def ctrl_c():
    """Press it, from any thread."""
    # Tests that run in the background inherit that it is ignored; a user's shell does not.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield lambda: signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
    signal.signal(signal.SIGINT, before)


def add(letter):
    return lambda text: text + letter


def test_items_go_through_all_stages_in_order():
    done = []
    pipeline.run(map(str, range(50)), [add("a"), add("b"), add("c")], done.append)
    assert done == [f"{k}abc" for k in range(50)]


def test_without_stages_or_items_there_is_nothing_to_wait_for():
    done = []
    pipeline.run([1, 2], [], done.append)
    pipeline.run([], [add("a")], done.append)
    assert done == [1, 2]


def test_the_source_and_all_stages_are_at_work_at_the_same_time():
    # Each waits for the other two; in turn they would wait for ever.
    together = threading.Barrier(3)

    def meet(item):
        if item == 3 - stage_of[threading.current_thread()]:
            together.wait(timeout=30)
        return item

    stage_of = {}

    def stage(number):
        def work(item):
            stage_of.setdefault(threading.current_thread(), number)
            return meet(item)

        return work

    def source():
        stage_of[threading.current_thread()] = 0
        for item in range(5):
            meet(item)
            yield item

    done = []
    pipeline.run(source(), [stage(1), stage(2)], done.append)
    assert done == list(range(5))


def test_source_and_finished_run_in_the_caller_s_thread():
    threads = set()

    def source():
        for _ in range(3):
            threads.add(threading.current_thread())
            yield ""

    pipeline.run(source(), [add("a")], lambda _: threads.add(threading.current_thread()))
    assert threads == {threading.current_thread()}


@pytest.mark.parametrize("slow", [0, 1, 2])
def test_a_slow_stage_holds_the_source_back(slow):
    made, done = [], []
    most = 0

    def source():
        for item in range(30):
            made.append(item)
            yield item

    def work(number):
        def stage(item):
            nonlocal most
            if number == slow:
                time.sleep(0.005)
                most = max(most, len(made) - item)
            return item

        return stage

    pipeline.run(source(), [work(0), work(1), work(2)], done.append)
    assert done == made == list(range(30))
    # Up to the slow stage: one at work and one that waits in each, and one that the source holds.
    assert most <= 2 * (slow + 1) + 1


@pytest.mark.parametrize("failing", ["source", "first", "last", "finished"])
def test_the_items_before_an_error_go_through_all_stages(failing):
    done = []

    def check(where, item):
        if where == failing and item == 7:
            raise ArithmeticError(where)

    def source():
        for item in range(100):
            check("source", item)
            yield item

    def stage(where):
        def work(item):
            time.sleep(0.001)
            check(where, item)
            return item

        return work

    def finished(item):
        check("finished", item)
        done.append(item)

    with pytest.raises(ArithmeticError, match=failing):
        pipeline.run(source(), [stage("first"), stage("middle"), stage("last")], finished)
    assert done[:7] == list(range(7))
    if failing != "finished":  # whoever notes items may go on with those that are done
        assert len(done) == 7


def test_of_two_errors_that_of_the_first_item_counts():
    second_failed = threading.Event()

    def early(item):
        if item == 3:
            second_failed.set()
            raise ValueError("item 3")
        return item

    def late(item):
        if item == 2:
            assert second_failed.wait(timeout=30)
            raise ValueError("item 2")
        return item

    done = []
    with pytest.raises(ValueError, match="item 2"):
        pipeline.run(range(100), [early, late], done.append)
    assert done == [0, 1]


def test_ctrl_c_ends_the_source_and_what_is_under_way_is_finished(ctrl_c):
    done = []

    def source():
        yield from range(10)
        ctrl_c()
        time.sleep(30)

    def slow(item):
        time.sleep(0.01)
        return item

    with pytest.raises(KeyboardInterrupt):
        pipeline.run(source(), [slow, slow], done.append)
    assert done == list(range(10))


def test_a_second_ctrl_c_drops_what_waits(ctrl_c):
    first_seen, done, begun = threading.Event(), [], []

    def source():
        try:
            yield from range(2)
            ctrl_c()
            time.sleep(30)
        finally:
            first_seen.set()

    def work(item):
        begun.append(item)
        if item == 0:
            assert first_seen.wait(timeout=30)
            time.sleep(0.1)  # until the main thread waits for the rest
            ctrl_c()
            time.sleep(0.1)
        return item

    before = threading.active_count()
    with pytest.raises(KeyboardInterrupt):
        pipeline.run(source(), [work], done.append)
    assert begun == [0]
    assert done == []
    assert threading.active_count() == before


def test_no_thread_is_left_behind():
    before = threading.active_count()
    pipeline.run(range(5), [add] * 3, lambda _: None)
    with pytest.raises(ZeroDivisionError):
        pipeline.run(range(5), [lambda k: 1 / k, lambda k: k], lambda _: None)
    assert threading.active_count() == before


def test_an_item_is_forgotten_when_it_is_done():
    class Large:
        alive = 0

        def __init__(self):
            Large.alive += 1

        def __del__(self):
            Large.alive -= 1

    most = []
    pipeline.run((Large() for _ in range(30)), [lambda k: k], lambda _: most.append(Large.alive))
    assert max(most) <= 5
    assert Large.alive == 0
