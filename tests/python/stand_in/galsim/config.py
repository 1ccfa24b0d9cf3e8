# SPDX-License-Identifier: GPL-3.0-or-later
"""Of galsim.config: object types, and parameters that are plain values."""
_types = {}


def RegisterObjectType(name, builder):
    _types[name] = builder


def GetAllParams(config, base, req={}, opt={}, single=(), ignore=()):
    keys = set(config) - {"type", "index_key"} - set(ignore)
    if not set(req) <= keys <= set(req) | set(opt):
        raise ValueError("parameters %s" % sorted(keys))
    return {key: {**req, **opt}[key](config[key]) for key in keys}, True


def ParseAberrations(key, config, base, name):
    return [0.0] * 4 + list(config[key]) if key in config else None


def BuildGSObject(config, key, base=None):
    field = config[key]
    return _types[field["type"]](field, {} if base is None else base, [], {}, None)
