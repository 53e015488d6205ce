#include "tests/support/Figures.h"

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {

const nlohmann::json& figuresOf(std::string_view name) {
    static std::map<std::string, nlohmann::json, std::less<>> read;
    const auto known = read.find(name);
    if (known != read.end()) return known->second;
    const auto path = sourceDir() / "tests/reference" / (std::string(name) + ".json");
    const auto text = accepted(readTextFile(path));
    const auto figures = accepted(parseJson(text, path.string()));
    return read.emplace(name, figures).first->second;
}

}  // namespace tacto::test
