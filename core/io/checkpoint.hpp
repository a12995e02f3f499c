#pragma once
#include <functional>
#include <memory>

#include "core/io/archive.hpp"
#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus::inline io {

/// Checkpoint format: what `serialize` gives to its Archive, a group or dataset per name, as an HDF5 file
/// that any number of ranks can read, with a check sum (CheckpointSum). The file is complete on the disk
/// before it takes its name: whatever ends the program, the old file is there or the new one. Collective.
/// Throws std::runtime_error on every rank.
void write_checkpoint(const std::string& path, const LocalMesh& mesh,
                      const std::function<void(Archive&)>& serialize);

/// Opens a checkpoint for reading and proves it whole, to the last bit of its numbers. Collective. Throws
/// InputError on every rank.
std::unique_ptr<Archive> open_checkpoint(const std::string& path, const LocalMesh& mesh);

}  // namespace bulbus::inline io
