// Json.h - nlohmann's json, with its functions compiled once, in core/base: in each of 200 units they took half a
// second, and a program took them from whichever unit it was linked with first, optimised or not.
//
// For precompiled headers; sources include <nlohmann/json.hpp>, as if this were not.
//
// Thread-safety: nlohmann's.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
