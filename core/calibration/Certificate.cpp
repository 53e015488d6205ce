#include "core/calibration/Certificate.h"

#include <cmath>

#include "core/base/Printable.h"
#include "core/base/RecordFields.h"
#include "core/base/Text.h"

namespace tacto {

Result<void> check(const Certificate& certificate) {
    constexpr std::size_t kLongest = 100;
    for (const auto& each : kCertificateTexts) {
        const auto& text = certificate.*each.member;
        if (trimmed(text).empty()) {
            return fail(ErrorCode::InvalidArgument, "certificate: the {} is empty; one is expected", each.title);
        }
        if (text.size() > kLongest || printable(text) != text) {
            return fail(ErrorCode::InvalidArgument,
                        "certificate: the {} is \"{}\"; at most {} bytes of printable text are accepted", each.title,
                        printable(std::string_view(text).substr(0, kLongest)), kLongest);
        }
    }
    if (!certificate.date.ok() || !certificate.due.ok()) {
        return fail(ErrorCode::InvalidArgument, "certificate {}: date and due date are days as 2026-11-21",
                    certificate.number);
    }
    if (certificate.due < certificate.date) {
        return fail(ErrorCode::InvalidArgument,
                    "certificate {}: it is due on {}, before its date {}; a later day is expected", certificate.number,
                    dateText(certificate.due), dateText(certificate.date));
    }
    for (const auto& each : kCertificateFigures) {
        const auto& u = certificate.*each.member;
        if (!u && !each.required) continue;
        if (!u) {
            return fail(ErrorCode::InvalidArgument,
                        "certificate {}: U of the {} is missing; above 0 to {} {} is accepted", certificate.number,
                        each.title, each.most, each.unit);
        }
        if (!(*u > 0) || !(*u <= each.most)) {
            return fail(ErrorCode::InvalidArgument,
                        "certificate {}: U of the {} is {} {}; above 0 to {} {} is accepted", certificate.number,
                        each.title, *u, each.unit, each.most, each.unit);
        }
    }
    return {};
}

/// The part of a rectangle about its middle that holds 95 % of it.
constexpr double kOfARectangle = 0.95;

InstrumentStatement statementOf(const Certificate& certificate) {
    const std::string by = certificateText(certificate);
    const auto halfWidth = [&](const CertificateFigure& figure) -> Stated {
        const auto& u = certificate.*figure.member;
        if (!u) return {};
        return {*u * figure.perUnit / kOfARectangle, by};
    };
    const auto& [gain, timeBase, shunt, probe] = kCertificateFigures;
    InstrumentStatement out;
    out.voltage.gain = out.current.gain = halfWidth(gain);
    out.timeBase = halfWidth(timeBase);
    out.current.probe = halfWidth(shunt);
    out.voltage.probe = halfWidth(probe);
    return out;
}

std::string certificateText(const Certificate& certificate) {
    return fmt::format("certificate {} ({}, {}, due {})", certificate.number, certificate.by,
                       dateText(certificate.date), dateText(certificate.due));
}

std::string figuresText(const Certificate& certificate) {
    std::string stated, not_;
    for (const auto& each : kCertificateFigures) {
        if (const auto& u = certificate.*each.member)
            stated += fmt::format("{}{} {:g} {}", stated.empty() ? "" : ", ", each.title, *u, each.unit);
        else
            not_ += fmt::format("{}{}", not_.empty() ? "" : ", ", each.title);
    }
    return fmt::format("U (k = 2): {}{}{}", stated, not_.empty() ? "" : "; not stated: ", not_);
}

namespace {

RecordFields<Certificate> buildCertificateFields() {
    RecordFields<Certificate> all;
    for (const auto& each : kCertificateTexts) all.text(each.key, each.member).required = true;
    all.add("date", &Certificate::date, dateKind()).required = true;
    all.add("due", &Certificate::due, dateKind()).required = true;
    for (const auto& each : kCertificateFigures)
        all.number(each.key, each.member, {.low = 0, .high = each.most, .openLow = true, .unit = each.unit});
    all.passOverUnknownKeys();
    all.rule([](const Certificate& certificate) { return check(certificate); });
    return all;
}

const RecordFields<Certificate>& certificateFields() {
    static const auto fields = buildCertificateFields();
    return fields;
}

}  // namespace

nlohmann::json toJson(const Certificate& certificate) { return certificateFields().write(certificate); }

Result<Certificate> certificateFrom(const nlohmann::json& json) {
    return certificateFields().read(json, {.path = "certificate"});
}

}  // namespace tacto
