"""The one error of this package."""


class Error(Exception):
    """What failed and how to mend it.

    code: a short name, alike in the command line's JSON: "usage", "invalid", "not_found", "format", "corrupt", "io",
    "held", "unsupported", "memory", "cancelled", "engine" or "internal". message: one line that says what happened.
    hint: how to mend it; may be empty. gone: whether it says that no engine answers.
    """
    gone = False

    def __init__(self, code, message, hint=""):
        super().__init__(f"{message} ({hint})" if hint else message)
        self.code = code
        self.message = message
        self.hint = hint
