// Files and folders that a process left because it was killed, and their removal by a later one.
// A name tells its process: ".STEM.PID.partial.EXT" beside a result, "arthroscene-PID-XXXXXX" in
// the system's temporary folder. Only what this user owns, what no live process made and what has
// not changed for a while is removed.
#pragma once

#include <chrono>
#include <filesystem>

namespace arthro {

// A process of another machine or container that shares the folder cannot be seen, so what was
// changed lately is left alone.
constexpr std::chrono::seconds kLeastLeftoverAge{60};

// Removes unfinished results directly in `folder`; empty: the current one, as the parent of a plain
// file name is. Throws nothing: what cannot be removed stays.
void RemoveLeftovers(const std::filesystem::path& folder,
                     std::chrono::seconds least_age = kLeastLeftoverAge) noexcept;

// Makes a folder of this process in the system's temporary one, after removing those of dead
// processes. Throws Error(kFile) when it cannot be made.
std::filesystem::path MakeTemporaryFolder();

}  // namespace arthro
