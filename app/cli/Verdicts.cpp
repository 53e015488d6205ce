#include "app/cli/Verdicts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "core/base/JsonText.h"

namespace tacto::cli {

int exitForVerdict(std::string_view verdict) noexcept {
    if (verdict == "fail") return kVerdictFailed;
    if (verdict == "indeterminate") return kIndeterminate;
    if (verdict == "stopped") return kStopped;
    return kDone;
}

void printResults(const nlohmann::json& results) {
    TextTable table({"", ""});
    for (const auto& [key, value] : results.items()) {
        if (key != "verdict") table.add({key, value.is_string() ? value.get<std::string>() : dumpJson(value)});
    }
    say("\n");
    table.print();
}

void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons) {
    TextTable table({"", ""});
    table.add({"verdict", std::string(verdict)});
    for (const auto& reason : reasons) table.add({"", reason});
    table.print();
}

}  // namespace tacto::cli
