#include "core/study/SessionSeal.h"

#include "core/seal/SealedText.h"

namespace tacto {

SessionSeal::SessionSeal(std::string study, std::string file, Secret key)
    : study_(std::move(study)), file_(std::move(file)), key_(std::move(key)) {}

std::string SessionSeal::place(std::int64_t seq, std::string_view kind) const {
    return fmt::format("{}\n{}\n{}\n{}", study_, file_, seq, kind);
}

std::string SessionSeal::sealText(std::int64_t seq, std::string_view kind, std::string_view text) const {
    return tacto::sealText(key_, place(seq, kind), text);
}

Result<std::string> SessionSeal::openText(std::int64_t seq, std::string_view kind, std::string_view sealed) const {
    return tacto::openText(key_, place(seq, kind), sealed);
}

std::vector<std::byte> SessionSeal::sealBytes(std::int64_t seq, std::string_view kind,
                                              std::span<const std::span<const std::byte>> parts) const {
    return tacto::sealBytes(key_, place(seq, kind), kChunkBlock, parts);
}

Result<std::vector<std::byte>> SessionSeal::openBytes(std::int64_t seq, std::string_view kind,
                                                      std::span<const std::byte> sealed) const {
    return tacto::openBytes(key_, place(seq, kind), kChunkBlock, sealed);
}

}  // namespace tacto
