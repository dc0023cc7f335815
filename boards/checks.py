"""What every board's run.py says where a board does otherwise than it must."""


class Failure(Exception):
    """The board does not do what it must; the text says what."""


def require(condition, text):
    if not condition:
        raise Failure(text)
