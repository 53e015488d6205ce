#include "core/calibration/CertificateDetails.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/calibration/ChainedLines.h"

namespace tacto {

namespace {

/// Returns the accepted keys: "laboratory, address, place".
std::string detailKeys(bool laboratoryAlone) {
    std::string all;
    for (const auto& detail : kCertificateDetails) {
        if (laboratoryAlone && !detail.ofLaboratory) continue;
        all += (all.empty() ? "" : ", ") + std::string(detail.key);
    }
    return all;
}

Result<void> readInto(CertificateDetails& details, const std::filesystem::path& file, bool laboratoryAlone) {
    const auto text = readTextFile(file);
    if (!text) return failure(text);
    const auto name = file.string();
    const auto document = parseJson(*text, name);
    if (!document) return failure(document);
    if (!document->is_object()) {
        return fail(ErrorCode::ParseError, "{}: an object of texts is expected, with the keys {}", name,
                    detailKeys(laboratoryAlone));
    }
    for (const auto& [key, value] : document->items()) {
        const auto known = std::ranges::find(kCertificateDetails, key, &CertificateDetail::key);
        if (known == kCertificateDetails.end() || (laboratoryAlone && !known->ofLaboratory)) {
            return fail(ErrorCode::ParseError, "{}: the key \"{}\" is {}; {} are accepted{}", name, printable(key),
                        known == kCertificateDetails.end() ? "unknown" : "that of an order",
                        detailKeys(laboratoryAlone), laboratoryAlone ? " where the laboratory's own are kept" : "");
        }
        const auto* said = value.get_ptr<const std::string*>();
        if (said == nullptr || printable(*said) != *said || charactersOf(*said) > kDetailLimit) {
            return fail(ErrorCode::ParseError,
                        "{}: \"{}\" is {}; one line of text of at most {} characters is expected", name, key,
                        said == nullptr ? shownJson(value) : '"' + printable(said->substr(0, 60)) + '"', kDetailLimit);
        }
        if (known->isDate && !said->empty() && !parseDate(*said)) {
            return fail(ErrorCode::ParseError, "{}: \"{}\" is \"{}\"; a date as \"2026-11-21\" is expected", name, key,
                        *said);
        }
        details.*known->member = *said;
    }
    return {};
}

}  // namespace

std::filesystem::path certificateDetailsFile() { return labFile("certificate-details.json"); }

Result<CertificateDetails> certificateDetails(const std::filesystem::path& file, CalibrationDate today) {
    CertificateDetails details;
    std::error_code ignored;
    if (const auto kept = certificateDetailsFile(); std::filesystem::exists(kept, ignored)) {
        if (auto read = readInto(details, kept, true); !read) return failure(read);
    }
    if (!file.empty()) {
        if (auto read = readInto(details, file, false); !read) return failure(read);
    }
    if (const auto received = parseDate(details.received); received && *received > today) {
        return invalid("{}: \"received\" is {}, after the calibration on {}; that day or an earlier one is expected",
                       file.string(), details.received, dateText(today));
    }
    if (const auto issued = parseDate(details.issued); issued && *issued < today) {
        return invalid("{}: \"issued\" is {}, before the calibration on {}; that day or a later one is expected",
                       file.string(), details.issued, dateText(today));
    }
    return details;
}

nlohmann::json toJson(const CertificateDetails& details) {
    auto out = nlohmann::json::object();
    for (const auto& detail : kCertificateDetails)
        if (const auto& text = details.*detail.member; !text.empty()) out[std::string(detail.key)] = text;
    return out;
}

}  // namespace tacto
