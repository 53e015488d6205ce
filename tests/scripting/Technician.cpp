#include "tests/scripting/Technician.h"

#include <regex>

namespace tacto::test {

namespace {

/// Returns the load that the operator's sentence asks for; empty if it names none.
std::string whatToFit(const std::string& text) {
    std::smatch found;
    if (std::regex_search(text, found, std::regex("into (.*): make and break"))) {
        return found[1].str() + ", intermittent 50 % seed 1";
    }
    if (text.find("lift one lead") != std::string::npos) return "open";
    if (text.find("bridge it") != std::string::npos) return "short";
    if (std::regex_search(
            text, found, std::regex("^Fit (?:the load )?(.*?)(?: in place of the load| again)?(?:, then confirm)?$"))) {
        return found[1];
    }
    return {};
}

}  // namespace

Result<nlohmann::json> Technician::ask(const OperatorQuestion& question) {
    asked.push_back(question);
    if (question.name == "fit-load" || question.name == "change-load") {
        const auto load = whatToFit(question.text);
        if (load.empty()) return fail(ErrorCode::NotFound, "no technician understands \"{}\"", question.text);
        if (auto fitted = hand_->fitLoad(load); !fitted) return failure(fitted);
    }
    if (question.kind != OperatorQuestion::Kind::Confirm) {
        return fail(ErrorCode::NotFound, "the technician was not told what to answer to {}", question.name);
    }
    return nlohmann::json(true);
}

}  // namespace tacto::test
