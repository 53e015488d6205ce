// The files of a study (settings, key files, rows of its ledger with their sealed contents) are read or refused with a
// sentence (hazard H10), and nothing that was altered can be opened (hazards H8 and H11). The first byte chooses what
// the rest is: study.json; a rehearsal's key file; changes to a key file with a passphrase, each with two bytes of
// position and one byte to XOR there; rows of a ledger, one "NAME JSON" a line; or a sealed text.
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "core/base/Clock.h"
#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/seal/SealedText.h"
#include "core/session/SessionWriter.h"
#include "core/study/LedgerRows.h"
#include "core/study/StudyFiles.h"
#include "core/study/StudyKeys.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::StudyFilesFuzz {

namespace {

using namespace tacto;
using Input = std::span<const std::uint8_t>;

constexpr const char* kStudy = "0123456789abcdef";
constexpr const char* kPerson = "00112233445566aa";
constexpr std::size_t kMaxRows = 12;  // each row is committed to a disk

template <class T>
bool refused(const Result<T>& read) {
    if (read) return false;
    require(!read.error().message.empty());
    return true;
}
std::string_view textOf(Input input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

void checkSettings(Input input) {
    const auto settings = parseStudy(textOf(input), "study.json");
    if (refused(settings)) return;
    const auto again = parseStudy(studyText(*settings), "study.json");
    require(again && *again == *settings && protocolHash(*again) == protocolHash(*settings));
}

void checkRehearsalKeys(Input input) {
    const auto keys = StudyKeys::open(fuzz::inputFile("keys.json", input), kStudy, nullptr, PassphraseCost::least());
    if (refused(keys)) return;
    require(keys->study().size() == kKeyBytes);
    for (const auto& entry : keys->entries()) require(entry.key.size() == kKeyBytes && keys->byId(entry.id) != nullptr);
}

bool same(const Secret& a, const Secret& b) {
    return std::equal(a.bytes().begin(), a.bytes().end(), b.bytes().begin(), b.bytes().end());
}

/// Creates a key file that `passphrase` opens; null for a rehearsal's file.
StudyKeys newKeys(const char* name, const Passphrase* passphrase) {
    const auto file = fuzz::scratchFolder() / name;
    std::filesystem::remove(file);
    auto keys = StudyKeys::create(file, kStudy, passphrase, PassphraseCost::least());
    require(keys && keys->add(kPerson, "P-7K3M"));
    return std::move(*keys);
}

void checkKeysUnderAPassphrase(Input changes) {
    static const auto words = Passphrase::from("correct horse").value();
    static const auto made = newKeys("sealed-keys.json", &words);
    static const auto sound = readTextFile(fuzz::scratchFolder() / "sealed-keys.json").value();
    auto text = sound;
    for (std::size_t i = 0; i + 2 < changes.size(); i += 3)
        text[(changes[i] * 256U + changes[i + 1]) % text.size()] ^= static_cast<char>(changes[i + 2]);
    const Input altered(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    const auto file = fuzz::inputFile("altered-keys.json", altered);
    const auto keys = StudyKeys::open(file, kStudy, &words, PassphraseCost::least());
    if (refused(keys)) return require(text != sound);
    require(same(keys->study(), made.study()) && keys->entries().size() == 1);
    require(keys->entries()[0].code == "P-7K3M" && same(keys->entries()[0].key, made.entries()[0].key));
}

/// Seals the content under "content" in `row`, as the ledger does.
nlohmann::json sealedRow(nlohmann::json row, std::string_view name, std::int64_t seq, const StudyKeys& keys) {
    const auto content = row.find("content");
    if (content == row.end()) return row;
    const bool ofTheStudy = name == ledger::kAdverseEvent || name == ledger::kExported;
    const auto key = ofTheStudy ? Secret(keys.study().bytes()) : subkey(keys.byId(kPerson)->key, 0);
    row["sealed"] = sealedInLedger(kStudy, key, seq, name, *content);
    row.erase("content");
    return row;
}

void checkLedger(Input input) {
    static const auto keys = newKeys("rehearsal-keys.json", nullptr);
    const auto path = fuzz::scratchFolder() / "ledger.tacto";
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + ending);
    const VirtualClock clock;
    SessionAbout about;
    about.programVersion = "0";
    about.wallStart = "2026-11-20T14:03:05Z";
    auto writer = SessionWriter::create(path, about, clock);
    require(writer.has_value());
    auto seq = (*writer)->event(Instant{0}, ledger::kStudy, {{"settings", {{"participants_max", 5}}}, {"sha256", ""}});
    std::istringstream lines{std::string(textOf(input))};
    std::size_t rows = 0;
    for (std::string name, body; rows < kMaxRows && lines >> name && std::getline(lines, body);) {
        const auto row = parseJson(body, "fuzz");
        if (!row || !row->is_object()) continue;
        require(seq.has_value());
        seq = (*writer)->event(Instant{0}, name, sealedRow(*row, name, *seq + 1, keys));
        if (refused(seq)) return;
        ++rows;
    }
    require((*writer)->close().has_value());
    const auto reader = SessionReader::open(path);
    require(reader.has_value());
    const auto state = replay(*reader, kStudy, &keys);
    const auto withoutKeys = replay(*reader, kStudy, nullptr);
    if (refused(state)) return;
    require(withoutKeys && withoutKeys->participants.size() == state->participants.size());
    require(withoutKeys->sessions.size() == state->sessions.size() && withoutKeys->adverseEvents.empty());
    for (const auto& one : withoutKeys->participants) require(!one.readable && one.code.empty());
    for (const auto& [session, event] : state->adverseEvents) require(checkForLedger(event).has_value());
}

void checkSealed(Input input) {
    static const auto key = Secret::random(kKeyBytes);
    const auto text = textOf(input);
    require(!openText(key, "here", text));
    const auto sealed = sealText(key, "here", text);
    const auto opened = openText(key, "here", sealed);
    require(opened && *opened == text);
    require(!openText(key, "there", sealed));
    const auto bytes = bytesOfBase64(text);
    if (refused(bytes)) return;
    require(bytesOfBase64(base64Text(*bytes)).value() == *bytes);
    require(!openBytes(key, "here", kChunkBlock, *bytes));
}

}  // namespace

TACTO_FUZZ(StudyFilesFuzz, const std::uint8_t* data, std::size_t size) {
    constexpr void (*kChecks[])(Input) = {checkSettings, checkRehearsalKeys, checkKeysUnderAPassphrase, checkLedger,
                                          checkSealed};
    if (size > 0) kChecks[data[0] % std::size(kChecks)]({data + 1, size - 1});
    return 0;
}

}  // namespace tacto::fuzz::StudyFilesFuzz
