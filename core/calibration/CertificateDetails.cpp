#include "core/calibration/CertificateDetails.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/base/WholeFile.h"
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

Result<void> readInto(CertificateDetails& details, const nlohmann::json& document, const std::string& name,
                      bool laboratoryAlone) {
    if (!document.is_object()) {
        return fail(ErrorCode::ParseError, "{}: an object of texts is expected, with the keys {}", name,
                    detailKeys(laboratoryAlone));
    }
    for (const auto& [key, value] : document.items()) {
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

Result<void> readInto(CertificateDetails& details, const std::filesystem::path& file, bool laboratoryAlone) {
    const auto text = readTextFile(file);
    if (!text) return failure(text);
    const auto document = parseJson(*text, file.string());
    return document ? readInto(details, *document, file.string(), laboratoryAlone) : failure(document);
}

Result<void> judgeDays(const CertificateDetails& details, const std::string& name, CalibrationDate today) {
    if (const auto received = parseDate(details.received); received && *received > today) {
        return invalid("{}: \"received\" is {}, after the calibration on {}; that day or an earlier one is expected",
                       name, details.received, dateText(today));
    }
    if (const auto issued = parseDate(details.issued); issued && *issued < today) {
        return invalid("{}: \"issued\" is {}, before the calibration on {}; that day or a later one is expected", name,
                       details.issued, dateText(today));
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
    if (auto days = judgeDays(details, file.string(), today); !days) return failure(days);
    return details;
}

Result<void> keepCertificateDetails(const CertificateDetails& details, const std::filesystem::path& file,
                                    CalibrationDate today) {
    const std::string name = "the certificate";
    CertificateDetails laboratory, order, read;
    for (const auto& detail : kCertificateDetails)
        (detail.ofLaboratory ? laboratory : order).*detail.member = details.*detail.member;
    const auto own = toJson(laboratory), ordered = toJson(order);
    for (const auto* part : {&own, &ordered})
        if (auto well = readInto(read, *part, name, false); !well) return well;
    if (auto days = judgeDays(read, name, today); !days) return days;
    if (auto now = certificateDetails({}, today); !now) return failure(now);  // a file that cannot be read stays
    const auto kept = certificateDetailsFile();
    std::error_code ignored;
    std::filesystem::create_directories(kept.parent_path(), ignored);
    if (auto written = writeWholeFile(kept, dumpJson(own)); !written) return written;
    return writeWholeFile(file, dumpJson(ordered));
}

nlohmann::json toJson(const CertificateDetails& details) {
    auto out = nlohmann::json::object();
    for (const auto& detail : kCertificateDetails)
        if (const auto& text = details.*detail.member; !text.empty()) out[std::string(detail.key)] = text;
    return out;
}

}  // namespace tacto
