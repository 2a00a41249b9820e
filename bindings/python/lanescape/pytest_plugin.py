"""pytest's fixture for hosts' kernels; an entry point of the group pytest11."""

import pytest


@pytest.fixture(scope="session")
def lanescape_verify():
    """lanescape.verification.verify: calls a kernel in every case, and fails the test by naming the worst one.

    def test_my_kernel(lanescape_verify):
        report = lanescape_verify(my_kernel)
        assert report["compared"] > 100
    """
    from lanescape.verification import verify  # not before a test asks for it: pytest loads this module in every session

    return verify
