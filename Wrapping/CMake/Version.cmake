# The version, for this project and for the ParaView plugin, which is a project of its own.
set(SPECTRALWATERMARK_VERSION 0.1.0)
