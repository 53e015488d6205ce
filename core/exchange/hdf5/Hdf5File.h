// Hdf5File.h - writes an HDF5 file in netCDF-4's layout: groups of one-dimensional data sets on a dimension scale.
//
// The same calls make the same bytes: no time of day is stored. File format not above HDF5 1.8.
//
// Thread-safety: one owner; a lock of the process holds others off while a file is open, because the library has one
// state for all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/exchange/hdf5/Hdf5Chunk.h"

namespace tacto {

/// An identifier of the library, closed by its owner.
class Hdf5Id {
public:
    Hdf5Id() = default;
    Hdf5Id(hid_t id, herr_t (*closer)(hid_t)) noexcept : id_(id), close_(closer) {}
    Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Id& operator=(Hdf5Id&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Id() {
        if (id_ >= 0) static_cast<void>(close_(id_));
    }
    [[nodiscard]] operator hid_t() const noexcept { return id_; }
    /// Closes now. Errors: Io.
    [[nodiscard]] Result<void> close();

private:
    hid_t id_ = -1;
    herr_t (*close_)(hid_t) = nullptr;
};

/// Where attributes are put: a group, a data set or the file's root.
class Hdf5Object {
public:
    explicit Hdf5Object(Hdf5Id id) noexcept : id_(std::move(id)) {}
    /// Text of fixed length, UTF-8.
    [[nodiscard]] Result<void> attribute(const char* name, std::string_view text);
    [[nodiscard]] Result<void> attribute(const char* name, double value);
    [[nodiscard]] Result<void> attribute(const char* name, std::span<const double> values);
    [[nodiscard]] Result<void> attribute(const char* name, bool flag);  ///< 0 or 1
    [[nodiscard]] hid_t id() const noexcept { return id_; }

private:
    friend class Hdf5File;
    Hdf5Id id_;
};

class Hdf5File;

/// One column that grows: values are collected and written a chunk at a time.
class Hdf5Column {
public:
    static constexpr std::size_t kChunkRows = 65'536;
    enum class Type { Double, Float, Text };

    /// `rows`: how many there will be; kUnknownRows: it grows. The data set is made with the first chunk, or by end().
    /// The file outlives the column.
    Hdf5Column(Hdf5File& file, const Hdf5Object& group, std::string name, Type type, std::uint64_t rows = kUnknownRows);
    static constexpr std::uint64_t kUnknownRows = ~std::uint64_t{0};

    [[nodiscard]] Result<void> add(double value);
    /// Adds every `step`-th value, from the first.
    [[nodiscard]] Result<void> add(std::span<const double> values, std::size_t step);
    [[nodiscard]] Result<void> add(std::span<const float> values);
    [[nodiscard]] Result<void> add(std::string_view text);
    /// Writes what is left and returns the data set, for its attributes.
    [[nodiscard]] Result<Hdf5Object> end();

private:
    [[nodiscard]] Result<void> make(bool last);
    [[nodiscard]] Result<void> write(bool last);
    template <class Number>
    [[nodiscard]] Result<void> writeChunk(hsize_t from, std::vector<Number>& numbers);
    [[nodiscard]] Result<void> writeTexts(hsize_t from);
    [[nodiscard]] std::size_t collected() const noexcept;

    Hdf5Chunk* chunk_;
    hid_t group_;
    std::string name_;
    Type type_;
    std::uint64_t rows_;
    std::uint64_t written_ = 0;
    hsize_t chunkRows_ = kChunkRows;
    Hdf5Id set_;
    std::vector<double> doubles_;
    std::vector<float> floats_;
    std::vector<std::string> texts_;
    std::size_t textBytes_ = 0;
};

class Hdf5File {
public:
    /// Replaces the content of `path`. Errors: Io.
    [[nodiscard]] static Result<Hdf5File> create(const std::filesystem::path& path);
    [[nodiscard]] Hdf5Object& root() noexcept { return root_; }
    [[nodiscard]] Result<Hdf5Object> group(const std::string& path);
    /// Makes `scale` the dimension scale "time" and puts the other data sets on it. Errors: Io.
    [[nodiscard]] static Result<void> onScale(const Hdf5Object& scale, std::span<const Hdf5Object> others);
    [[nodiscard]] Result<void> close();

private:
    friend class Hdf5Column;
    Hdf5File(std::unique_lock<std::mutex> alone, Hdf5Id file, Hdf5Object root) noexcept
        : alone_(std::move(alone)), file_(std::move(file)), root_(std::move(root)) {}
    std::unique_lock<std::mutex> alone_;
    Hdf5Id file_;
    Hdf5Object root_;
    std::unique_ptr<Hdf5Chunk> chunk_ = std::make_unique<Hdf5Chunk>();  // of all columns
};

/// Returns the name of a link: without "/" and "." alone, which lead elsewhere.
[[nodiscard]] std::string hdf5Name(std::string_view name);

}  // namespace tacto
