// Boxed.h - an optional value that is usually missing: it takes the room of a pointer.
//
// As std::optional, which always keeps room for the value. Copies copy the value.
//
// Thread-safety: none; one owner.
#pragma once

#include <memory>
#include <utility>

namespace tacto {

template <class T>
class Boxed {
public:
    Boxed() = default;
    /// Implicit, so that a value is assigned as to a std::optional.
    Boxed(T value) : value_(std::make_unique<T>(std::move(value))) {}  // NOLINT(google-explicit-constructor)
    Boxed(const Boxed& other) : value_(other ? std::make_unique<T>(*other) : nullptr) {}
    Boxed(Boxed&&) noexcept = default;
    Boxed& operator=(const Boxed& other) {
        if (this != &other) *this = Boxed(other);
        return *this;
    }
    Boxed& operator=(Boxed&&) noexcept = default;
    ~Boxed() = default;

    [[nodiscard]] bool has_value() const noexcept { return value_ != nullptr; }
    [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
    /// Only where it has a value.
    [[nodiscard]] const T& operator*() const noexcept { return *value_; }
    [[nodiscard]] const T* operator->() const noexcept { return value_.get(); }

private:
    std::unique_ptr<T> value_;
};

}  // namespace tacto
