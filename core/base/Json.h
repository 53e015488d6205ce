// Json.h - nlohmann's json with its functions compiled once, in core/base. Otherwise each of 200 files took half a
// second, and a program used the functions of the file that was linked first, optimised or not.
//
// For precompiled headers; sources include <nlohmann/json.hpp> as usual.
//
// Thread-safety: nlohmann's.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
