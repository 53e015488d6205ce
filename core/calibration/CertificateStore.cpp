#include "core/calibration/CertificateStore.h"

#include <fmt/ranges.h>

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
        return fail(ErrorCode::NotFound, "there is no certificate \"{}\"{} that is not withdrawn", number,
                    serial.empty() ? "" : fmt::format(" of serial number \"{}\"", serial));
    }
    if (serials.size() > 1) {
        return fail(ErrorCode::InvalidArgument,
                    "certificate \"{}\" is entered for the serial numbers {}; it must be given with one of them",
                    number, fmt::join(serials, ", "));
    }
    return found;
}

Result<void> CertificateStore::add(const Certificate& certificate, CalibrationDate today) {
    if (auto sane = check(certificate); !sane) return sane;
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);
        if (standing(certificate.number, certificate.serial)) {
            return fail(
                ErrorCode::InvalidArgument,
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

}  // namespace tacto
