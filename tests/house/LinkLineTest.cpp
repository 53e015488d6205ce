// Every include follows the link lines: a file includes headers only from targets that its own target links, directly
// or through public links. A privately linked target is not passed on, and its headers may not be included.
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "tests/house/Layers.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

using test::readTargets;
using test::Targets;

/// Returns the targets with headers that `target` may include, with `target` itself.
std::set<std::string> reachOf(const Targets& targets, const std::string& target) {
    std::set<std::string> reached{target};
    auto waiting = targets.at(target).links;
    while (!waiting.empty()) {
        const auto next = waiting.back();
        waiting.pop_back();
        const auto found = targets.find(next);
        if (found == targets.end() || !reached.insert(next).second) continue;
        waiting.insert(waiting.end(), found->second.handsOn.begin(), found->second.handsOn.end());
    }
    return reached;
}

/// Finds the targets of a file: the one that compiles the source of that name; otherwise all with sources in the file's
/// folder; otherwise all with sources in the parent folder.
class Owners {
public:
    explicit Owners(const Targets& targets) {
        for (const auto& [name, target] : targets) {
            for (const fs::path source : target.sources) {
                named_[source.parent_path() / source.stem()].insert(name);
                folders_[source.parent_path()].insert(name);
            }
        }
    }
    std::set<std::string> of(const fs::path& file) const {
        const auto byName = named_.find(file.parent_path() / file.stem());
        if (byName != named_.end()) return byName->second;
        for (auto folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
            if (const auto found = folders_.find(folder); found != folders_.end()) return found->second;
        }
        return {};
    }

private:
    std::map<fs::path, std::set<std::string>> named_, folders_;
};

std::vector<std::string> includesIn(const fs::path& file) {
    constexpr std::string_view kBegin = "#include \"";
    std::vector<std::string> includes;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(kBegin)) continue;
        const auto path = line.substr(kBegin.size(), line.rfind('"') - kBegin.size());
        if (path.find('/') != std::string::npos) includes.push_back(path);
    }
    return includes;
}

/// Returns the faults in the includes of one file.
std::vector<std::string> faultsOf(const fs::path& file, const std::vector<std::string>& includes,
                                  const Targets& targets, const Owners& owners) {
    std::vector<std::string> faults;
    const auto own = owners.of(file);
    for (const auto& include : includes) {
        const auto theirs = owners.of(include);
        const bool links = std::any_of(own.begin(), own.end(), [&](const auto& target) {
            const auto reached = reachOf(targets, target);
            return std::any_of(theirs.begin(), theirs.end(), [&](const auto& t) { return reached.contains(t); });
        });
        if (!links) {
            faults.push_back(fmt::format("{} of the target {} includes {} of the target {}, which it does not link",
                                         file.string(), fmt::join(own, " or "), include, fmt::join(theirs, " or ")));
        }
    }
    return faults;
}

TEST(LinkLine, EveryIncludeFollowsIt) {
    const auto targets = test::targetsOfTheBuild();
    ASSERT_TRUE(targets.contains("tacto_base"));
    const Owners owners(targets);
    std::size_t files = 0;
    for (const char* top : {"core", "drivers", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / top)) {
            const auto ending = entry.path().extension();
            const auto file = fs::relative(entry.path(), test::sourceDir());
            // A build without Qt or without the programs has no targets for some files.
            if ((ending != ".cpp" && ending != ".h") || owners.of(file).empty()) continue;
            ++files;
            for (const auto& fault : faultsOf(file, includesIn(entry.path()), targets, owners)) ADD_FAILURE() << fault;
        }
    }
    EXPECT_GT(files, 300U);
}

TEST(LinkLine, AnIncludeBesideItIsNamed) {
    std::istringstream in(
        "target base\nsource core/base/Text.cpp\n"
        "target safety\nsource core/safety/Gate.cpp\nlinks base\nhands_on base\n"
        "target bench\nsource core/bench/Bench.cpp\nlinks safety\nhands_on $<LINK_ONLY:safety>\n"
        "target run\nsource app/run/Run.cpp\nlinks bench\nhands_on bench\n");
    const auto targets = readTargets(in);
    const Owners owners(targets);
    const auto faults = [&](const char* file, const char* include) {
        return faultsOf(file, {include}, targets, owners);
    };
    EXPECT_TRUE(faults("core/safety/Gate.cpp", "core/base/Text.h").empty());
    EXPECT_TRUE(faults("core/bench/Loop.h", "core/base/Text.h").empty()) << "handed on";
    EXPECT_TRUE(faults("core/bench/Bench.cpp", "core/bench/parts/Loop.h").empty()) << "a folder of the same target";
    EXPECT_EQ(faults("core/base/Text.cpp", "core/safety/Gate.h"),
              std::vector<std::string>{"core/base/Text.cpp of the target base includes core/safety/Gate.h of the "
                                       "target safety, which it does not link"});
    EXPECT_EQ(faults("app/run/Run.cpp", "core/safety/Gate.h").size(), 1U) << "linked privately by bench";
    EXPECT_EQ(faults("app/run/Run.cpp", "core/nowhere/Thing.h").size(), 1U) << "no target";
}

}  // namespace
}  // namespace tacto
