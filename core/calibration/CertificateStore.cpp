#include "core/calibration/CertificateStore.h"

#include <cmath>
#include <fmt/ranges.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/RecordFields.h"
#include "core/base/Words.h"

namespace tacto {

namespace {
constexpr Word<CertificateState> kCertificateStateWords[] = {{"in use", CertificateState::Counts},
                                                             {"superseded", CertificateState::Superseded},
                                                             {"expired", CertificateState::Expired},
                                                             {"dated in the future", CertificateState::NotYet},
                                                             {"withdrawn", CertificateState::Withdrawn}};
}  // namespace

std::string_view nameOf(CertificateState state) noexcept { return wordFor(kCertificateStateWords, state); }

Result<CertificateStore> CertificateStore::open(std::filesystem::path file) {
    CertificateStore store(std::move(file));
    if (auto done = store.read(); !done) return failure(done);
    return store;
}

Result<void> CertificateStore::read() {
    all_.clear();
    return lines_.read([this](const nlohmann::json& line) { return take(line); });
}

Result<void> CertificateStore::take(const nlohmann::json& line) {
    const auto dateAt = [](const nlohmann::json& in, const char* key) -> std::optional<CalibrationDate> {
        const auto found = in.find(key);
        const auto* text = found == in.end() ? nullptr : found->get_ptr<const std::string*>();
        return text == nullptr ? std::nullopt : parseDate(*text);
    };
    const auto day = dateAt(line, "entered");
    if (!day) return fail(ErrorCode::ParseError, "this line does not say when it was entered");
    if (const auto withdrawal = line.find("withdrawal"); withdrawal != line.end()) {
        const auto textAt = [&](const char* key) {
            const auto found = withdrawal->is_object() ? withdrawal->find(key) : withdrawal->end();
            const auto* text = found == withdrawal->end() ? nullptr : found->get_ptr<const std::string*>();
            return text == nullptr ? std::string() : *text;
        };
        const auto found = standing(textAt("number"), textAt("serial"));
        if (!found) return failure(found);
        (*found)->withdrawn = *day;
        return {};
    }
    auto certificate = certificateFrom(line.value("certificate", nlohmann::json()));
    if (!certificate) return failure(certificate);
    all_.push_back({std::move(*certificate), *day});
    return {};
}

Result<EnteredCertificate*> CertificateStore::standing(std::string_view number, std::string_view serial) {
    EnteredCertificate* found = nullptr;
    std::vector<std::string_view> serials;
    for (auto& entered : all_) {
        const auto& [certificate, since, withdrawn] = entered;
        if (certificate.number != number || withdrawn) continue;
        if (!serial.empty() && certificate.serial != serial) continue;
        found = &entered;
        serials.push_back(certificate.serial);
    }
    if (found == nullptr) {
        return fail(ErrorCode::NotFound, "certificate \"{}\"{} does not exist or is withdrawn", number,
                    serial.empty() ? "" : fmt::format(" of serial number \"{}\"", serial));
    }
    if (serials.size() > 1) {
        return invalid("certificate \"{}\" is entered for the serial numbers {}; it must be given with one of them",
                       number, fmt::join(serials, ", "));
    }
    return found;
}

Result<void> CertificateStore::add(const Certificate& certificate, CalibrationDate today) {
    if (auto sane = check(certificate); !sane) return sane;
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);
        if (standing(certificate.number, certificate.serial)) {
            return invalid(
                "certificate \"{}\" of serial number \"{}\" is entered already; withdraw it first to correct it",
                certificate.number, certificate.serial);
        }
        return nlohmann::json{{"certificate", toJson(certificate)}, {"entered", dateText(today)}};
    });
    if (added) all_.push_back({certificate, today});
    return added;
}

Result<void> CertificateStore::withdraw(std::string_view number, std::string_view serial, CalibrationDate today) {
    EnteredCertificate* entered = nullptr;
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);
        const auto found = standing(number, serial);
        if (!found) return failure(found);
        entered = *found;
        return nlohmann::json{{"withdrawal", {{"number", number}, {"serial", entered->certificate.serial}}},
                              {"entered", dateText(today)}};
    });
    if (added) entered->withdrawn = today;
    return added;
}

std::optional<std::size_t> CertificateStore::newest(std::string_view serial, CalibrationDate day) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const auto& [certificate, entered, withdrawn] = all_[i];
        if (serial.empty() || certificate.serial != serial || withdrawn) continue;
        if (!found) {
            found = i;
            continue;
        }
        const auto& before = all_[*found].certificate.date;
        const bool begun = certificate.date <= day, beforeBegun = before <= day;
        if (begun != beforeBegun ? begun : begun ? certificate.date >= before : certificate.date < before) found = i;
    }
    return found;
}

CertificateState CertificateStore::state(std::size_t index, CalibrationDate day) const {
    const auto& [certificate, entered, withdrawn] = all_[index];
    if (withdrawn) return CertificateState::Withdrawn;
    if (certificate.date > day) return CertificateState::NotYet;
    if (newest(certificate.serial, day) != index) return CertificateState::Superseded;
    return certificate.due < day ? CertificateState::Expired : CertificateState::Counts;
}

std::filesystem::path certificateFile() { return labFile("certificates.jsonl"); }

Result<void> check(const Certificate& certificate) {
    constexpr std::size_t kLongest = 100;
    for (const auto& each : kCertificateTexts) {
        const auto& text = certificate.*each.member;
        if (trimmed(text).empty()) {
            return invalid("certificate: the {} is empty; one is expected", each.title);
        }
        if (text.size() > kLongest || printable(text) != text) {
            return invalid("certificate: the {} is \"{}\"; at most {} bytes of printable text are accepted", each.title,
                           printable(std::string_view(text).substr(0, kLongest)), kLongest);
        }
    }
    if (!certificate.date.ok() || !certificate.due.ok()) {
        return invalid("certificate {}: date and due date are days as 2026-11-21", certificate.number);
    }
    if (certificate.due < certificate.date) {
        return invalid("certificate {}: it is due on {}, before its date {}; a later day is expected",
                       certificate.number, dateText(certificate.due), dateText(certificate.date));
    }
    for (const auto& each : kCertificateFigures) {
        const auto& u = certificate.*each.member;
        if (!u && !each.required) continue;
        if (!u) {
            return invalid("certificate {}: U of the {} is missing; above 0 to {} {} is accepted", certificate.number,
                           each.title, each.most, each.unit);
        }
        if (!(*u > 0) || !(*u <= each.most)) {
            return invalid("certificate {}: U of the {} is {} {}; above 0 to {} {} is accepted", certificate.number,
                           each.title, *u, each.unit, each.most, each.unit);
        }
    }
    return {};
}

/// The middle part of a rectangular distribution that holds 95 % of it.
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

const RecordFields<Certificate>& certificateFields() { return builtOnce<buildCertificateFields>(); }

}  // namespace

nlohmann::json toJson(const Certificate& certificate) { return certificateFields().write(certificate); }

Result<Certificate> certificateFrom(const nlohmann::json& json) {
    return certificateFields().read(json, {.path = "certificate"});
}

}  // namespace tacto
