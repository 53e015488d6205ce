#include "core/exchange/recordings/OpenRecording.h"

#include <algorithm>
#include <fstream>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/exchange/edf/EdfFile.h"
#include "core/exchange/edf/EdfNames.h"
#include "core/exchange/xdf/XdfFile.h"

namespace tacto {

bool isSignalName(const std::filesystem::path& path) {
    const auto name = lowered(path.filename().string());
    return std::ranges::any_of(kSignalEndings, [&](const char* ending) { return name.ends_with(ending); });
}

Result<std::optional<SignalFile>> readSignals(const std::filesystem::path& path) {
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::string head(edf::kHeaderBytes, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    const bool named = isSignalName(path);
    const auto ending = lowered(path.extension().string());
    const bool isXdf = beginsAsXdf(head) || (named && ending != ".edf" && ending != ".bdf");
    if (!isXdf && !named && !beginsAsEdf(head)) return std::nullopt;
    auto file = isXdf ? readXdf(path) : readEdf(path);
    if (!file) return failure(file);
    return std::move(*file);
}

Result<Recording> openRecording(const std::filesystem::path& path) { return Recording::open(path, readSignals); }

Result<RecordingDraft> draftAnyRecording(const std::filesystem::path& path) {
    return draftRecording(path, readSignals);
}

}  // namespace tacto
