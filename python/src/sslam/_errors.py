"""What sslam raises. Every message is one line that begins with the argument or the file that is wrong."""


class Error(RuntimeError):
    """A file that cannot be read or written, or a call at a time when it makes no sense."""


class SettingsError(Error, ValueError):
    """Settings of a System that contradict themselves or each other."""


class FinishedError(Error):
    """A call that would change a System after finish()."""


class SslamWarning(UserWarning):
    """What sslam has to tell of its input: a frame that is skipped, a camera that is assumed."""
