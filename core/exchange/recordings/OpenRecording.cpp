#include "core/exchange/recordings/OpenRecording.h"

#include <fstream>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/exchange/edf/EdfFile.h"
#include "core/exchange/edf/EdfNames.h"
#include "core/exchange/xdf/XdfFile.h"
#include "core/exchange/xdf/XdfNames.h"

namespace tacto {

Result<std::optional<SignalFile>> readSignals(const std::filesystem::path& path) {
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::string head(edf::kHeaderBytes, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    const auto ending = lowered(path.extension().string());
    const bool isXdf = ending == ".xdf" || head.starts_with(xdf::kMagic);
    if (!isXdf && ending != ".edf" && ending != ".bdf" && !beginsAsEdf(head)) return std::nullopt;
    auto file = isXdf ? readXdf(path) : readEdf(path);
    if (!file) return failure(file);
    return std::move(*file);
}

Result<Recording> openRecording(const std::filesystem::path& path) { return Recording::open(path, readSignals); }

Result<RecordingDraft> draftAnyRecording(const std::filesystem::path& path) {
    return draftRecording(path, readSignals);
}

}  // namespace tacto
