// StudyKeys.h - the keys of a study: the study's own key, and one key with a code for each participant.
//
// The keys lie in one file outside the study's folder, sealed under a passphrase, mode 0600; a file that others may
// read, or a folder that others may write to, is refused (isOwnFile()). The opened content is binary, so that no key
// passes through a parser: 32 bytes of the study's key; 80 bytes about the ledger's end (8 of the row, 8 of its time,
// both with the low byte first, 64 digits of its hash; not in version 1); then 80 bytes for each participant (16 of the
// id, 32 of the code, 32 of the key). A rehearsal's file has no passphrase and states that it is not secret.
//
// Every change writes a new file in place of the old one and overwrites the old file's bytes.
//
// Thread-safety: one caller at a time.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/seal/Passphrase.h"
#include "core/seal/Secret.h"
#include "core/session/RowSeal.h"
#include "core/study/LedgerEnd.h"

namespace tacto {

class StudyKeys {
public:
    struct Entry {
        std::string id;
        std::string code;
        Secret key;
    };

    /// Creates the key file; a null `passphrase` is for a rehearsal. Errors: InvalidArgument if the file exists; Io.
    [[nodiscard]] static Result<StudyKeys> create(const std::filesystem::path& file, const std::string& study,
                                                  const Passphrase* passphrase, const PassphraseCost& cost);
    /// Errors: NotFound for a file that is missing, can be accessed by others, belongs to another study, or that the
    /// passphrase does not open; Unsupported for a file of a newer version; ParseError; Io.
    [[nodiscard]] static Result<StudyKeys> open(const std::filesystem::path& file, const std::string& study,
                                                const Passphrase* passphrase, const PassphraseCost& cost);

    [[nodiscard]] const Secret& study() const noexcept { return study_; }
    [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
    /// The ledger's end when the keys were last written; row 0 if not known.
    [[nodiscard]] const LedgerEnd& ledgerEnd() const noexcept { return end_; }
    /// Replaces the noted end. Errors: Io; the old note then stays.
    [[nodiscard]] Result<void> noteEnd(const LedgerEnd& end);
    /// Returns null if there is no such participant.
    [[nodiscard]] const Entry* byId(std::string_view id) const noexcept;

    /// Adds a participant with a new key. Errors: Io; then nothing is added.
    [[nodiscard]] Result<void> add(const std::string& id, const std::string& code);
    /// Deletes a participant's code and key from memory and file. Errors: Io.
    [[nodiscard]] Result<void> destroy(std::string_view id);
    /// Seals the whole file under another passphrase. If the program is killed, either the old or the new one opens it.
    /// Errors: Unsupported for a rehearsal; Io, and then the old one stays.
    [[nodiscard]] Result<void> sealUnder(const Passphrase& passphrase, const PassphraseCost& cost);

private:
    StudyKeys(std::filesystem::path file, std::string study) : file_(std::move(file)), studyId_(std::move(study)) {}
    [[nodiscard]] Secret content() const;
    [[nodiscard]] Result<void> take(const Secret& content, bool saysEnd);
    [[nodiscard]] Result<void> write() const;
    /// Draws a salt and makes the key of the file. Errors: as Passphrase::keyFor().
    [[nodiscard]] Result<void> lockWith(const Passphrase& passphrase, const PassphraseCost& cost);

    std::filesystem::path file_;
    std::string studyId_;
    std::array<std::byte, Passphrase::kSaltBytes> salt_{};
    std::optional<Secret> lock_;  // made from the passphrase; not set in a rehearsal
    Secret study_;
    LedgerEnd end_;
    std::vector<Entry> entries_;
};

// Seals the rows of one file of a study. Each seal is bound to study, file, row number and kind of row.

class SessionSeal final : public RowSeal {
public:
    /// `file`: the name of a session's file without its extension, or "ledger".
    SessionSeal(std::string study, std::string file, Secret key);

    [[nodiscard]] std::string sealText(std::int64_t seq, std::string_view kind, std::string_view text) const override;
    [[nodiscard]] Result<std::string> openText(std::int64_t seq, std::string_view kind,
                                               std::string_view sealed) const override;
    [[nodiscard]] std::vector<std::byte> sealBytes(std::int64_t seq, std::string_view kind,
                                                   std::span<const std::span<const std::byte>> parts) const override;
    [[nodiscard]] Result<std::vector<std::byte>> openBytes(std::int64_t seq, std::string_view kind,
                                                           std::span<const std::byte> sealed) const override;

private:
    [[nodiscard]] std::string place(std::int64_t seq, std::string_view kind) const;

    const std::string study_;
    const std::string file_;
    const Secret key_;
};

}  // namespace tacto
