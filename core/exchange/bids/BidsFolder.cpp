#include "core/exchange/bids/BidsFolder.h"

#include <algorithm>

#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string labelOf(const ExportSource& source) {
    if (source.simulated()) return "sim";
    // Of a study's session the code is not among the parameters.
    const auto named = textOr(valueOr(source.description(), "parameters"), "participant");
    if (source.about().mode == "person" || !named.empty()) return bidsLabelOf(named, "participant");
    return "bench";
}

}  // namespace

std::string bidsLabelOf(std::string_view text, std::string_view otherwise) {
    std::string label;
    for (const char c : text) {
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) label += c;
    }
    return label.empty() ? std::string(otherwise) : label;
}

std::string bidsUnit(std::string_view unit) {
    if (unit.empty()) return "1";
    std::string out(unit);
    if (out.size() > 1 && out.back() == '2') out.insert(out.size() - 1, "^");
    return out;
}

BidsColumn bidsColumn(const ResultColumn& column) {
    return {column.at, column.title, ExportTable::holdsText(column) ? std::string() : bidsUnit(column.unit)};
}

BidsFolder::BidsFolder(const ExportSource& source, fs::path root)
    : source_(source),
      root_(std::move(root)),
      label_(labelOf(source)),
      task_(bidsLabelOf(textOr(source.description(), "protocol"), "session")) {}

Result<fs::path> BidsFolder::path(std::string_view datatype, std::string_view suffix) const {
    const auto folder = root_ / subject() / datatype;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return fail(ErrorCode::Io, "{} could not be written: {}", folder.string(), error.message());
    return folder / fmt::format("{}_task-{}_{}", subject(), task_, suffix);
}

json BidsFolder::sidecar(bool simulated) const {
    return {{"TaskName", task_},
            {"Simulated", simulated},
            {"Marks", source_.marks()},
            {"Session", source_.name()},
            {"ChainHead", source_.chainHead()}};
}

Result<void> BidsFolder::writeText(const fs::path& path, std::string_view text) const {
    const auto whole = root_ / path;
    auto out = FileOut::create(whole);
    return namedAs(whole, out ? out->write(text) : failure(out));
}

Result<void> BidsFolder::writeJson(const fs::path& path, const json& value) const {
    return writeText(path, dumpJson(value, 2) + "\n");
}

}  // namespace tacto
