// NamedGroups.h - rows of a script gathered by their names, in the order in which the names first come.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/Arguments.h"

namespace tacto {

/// The group of that name, made where there is none yet. `Group` has a `name`.
template <class Group>
[[nodiscard]] Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
    for (auto& group : groups) {
        if (group.name == name) return group;
    }
    groups.emplace_back().name = name;
    return groups.back();
}

/// Empty groups of `options.names`, so that a name without rows is missed. Errors: InvalidArgument for what is no text.
template <class Group>
[[nodiscard]] Result<std::vector<Group>> groupsAsked(const Arguments& arguments, const nlohmann::json& options) {
    std::vector<Group> groups;
    const auto names = options.find("names");
    if (names == options.end()) return groups;
    for (const auto& name : *names) {
        if (!name.is_string()) return arguments.wrong("names", *names, "a list of names");
        static_cast<void>(groupNamed(groups, name.get<std::string>()));
    }
    return groups;
}

}  // namespace tacto
