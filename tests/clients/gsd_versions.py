"""Version 3 of gsd calls a frame and the modes of files otherwise than the versions before."""
import gsd.hoomd

IS_NEW = hasattr(gsd.hoomd, "Frame")
Frame = gsd.hoomd.Frame if IS_NEW else gsd.hoomd.Snapshot
READ, WRITE, READ_AND_WRITE = ("r", "w", "r+") if IS_NEW else ("rb", "wb", "rb+")
