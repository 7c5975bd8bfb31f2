"""The exceptions of sslam. Each message is one line that begins with the wrong argument or file."""


class Error(RuntimeError):
    """A file that cannot be read or written, or a call that is not allowed in this state."""


class SettingsError(Error, ValueError):
    """Invalid or contradictory settings of a System."""


class FinishedError(Error):
    """A call that would change a System after finish()."""


class SslamWarning(UserWarning):
    """A warning about the input, such as a skipped frame or an assumed camera."""
