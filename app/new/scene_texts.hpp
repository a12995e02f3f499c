#pragma once
#include <string_view>

/// The files *.yaml of this folder, made part of the program by cmake/Embed.cmake.
namespace bulbus::inline app::scene_texts {

extern const std::string_view eye, sphere, mesh;

}  // namespace bulbus::inline app::scene_texts
