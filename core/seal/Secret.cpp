#include "core/seal/Secret.h"

#include <cstring>
#include <new>
#include <sodium.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <utility>

namespace tacto {

namespace {

/// A core dump would hold every key: not written, and not readable by other processes of this account.
void startWithoutCoreDumps() noexcept {
    static const bool started = [] {
        const ::rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
        return sodium_init() >= 0;
    }();
    static_cast<void>(started);
}

}  // namespace

Secret::Secret(std::size_t size) : size_(size) {
    startWithoutCoreDumps();
    data_ = static_cast<std::byte*>(sodium_malloc(size));
    if (data_ == nullptr) throw std::bad_alloc();
    std::memset(data_, 0, size);
}

Secret::Secret(std::span<const std::byte> bytes) : Secret(bytes.size()) {
    if (!bytes.empty()) std::memcpy(data_, bytes.data(), bytes.size());
}

Secret::~Secret() {
    if (data_ != nullptr) sodium_free(data_);  // wipes it
}

Secret::Secret(Secret&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

Secret& Secret::operator=(Secret&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

Secret Secret::random(std::size_t size) {
    Secret out(size);
    randombytes_buf(out.data_, size);
    return out;
}

}  // namespace tacto
