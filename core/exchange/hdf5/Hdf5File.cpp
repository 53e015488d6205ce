#include "core/exchange/hdf5/Hdf5File.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <hdf5_hl.h>

namespace tacto {

namespace {

constexpr std::size_t kMaxTextBytes = std::size_t{1} << 22;  // that a column of texts collects

std::mutex& libraryLock() {
    static std::mutex lock;
    return lock;
}

/// The library's reason for its last error: the system's words where it has them.
struct Hdf5Reason {
    std::string system;
    std::string innermost;
};

tl::unexpected<Error> because(const char* what) {
    Hdf5Reason reason;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_DOWNWARD,
        [](unsigned, const H5E_error2_t* error, void* to) -> herr_t {
            auto& found = *static_cast<Hdf5Reason*>(to);
            found.innermost = error->desc != nullptr ? error->desc : "";
            static constexpr std::string_view kBefore = "error message = '";
            if (const auto at = found.innermost.find(kBefore); at != std::string::npos) {
                const auto from = at + kBefore.size();
                found.system = found.innermost.substr(from, found.innermost.find('\'', from) - from);
            }
            return 0;
        },
        &reason);
    H5Eclear2(H5E_DEFAULT);
    if (!reason.system.empty()) return fail(ErrorCode::Io, "{}", reason.system);
    return fail(ErrorCode::Io, "the HDF5 library could not {} ({})", what, reason.innermost);
}

Hdf5Id owned(hid_t id, herr_t (*close)(hid_t)) { return {id, close}; }

Hdf5Id textType(std::size_t size) {
    auto type = owned(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, size);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/// Writes one attribute of `type` in `space`.
Result<void> writeAttribute(hid_t object, const char* name, hid_t stored, hid_t given, hid_t space, const void* value) {
    const auto attribute = owned(H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute < 0 || H5Awrite(attribute, given, value) < 0) return because("write an attribute");
    return {};
}

Hdf5Id groupProperties(hid_t kind) {
    auto properties = owned(H5Pcreate(kind), H5Pclose);
    // netCDF-4 keeps the order of variables.
    H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_obj_track_times(properties, false);
    return properties;
}

}  // namespace

Result<void> Hdf5Id::close() {
    const auto id = std::exchange(id_, -1);
    if (id >= 0 && close_(id) < 0) return because("close the file");
    return {};
}

Result<void> Hdf5Object::attribute(const char* name, std::string_view text) {
    const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
    const auto type = textType(padded.size());
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const auto space = owned(H5Screate(H5S_SCALAR), H5Sclose);
    return writeAttribute(id_, name, type, type, space, padded.data());
}

Result<void> Hdf5Object::attribute(const char* name, double value) {
    const auto space = owned(H5Screate(H5S_SCALAR), H5Sclose);
    return writeAttribute(id_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &value);
}

Result<void> Hdf5Object::attribute(const char* name, std::span<const double> values) {
    const hsize_t size = values.size();
    const auto space = owned(H5Screate_simple(1, &size, nullptr), H5Sclose);
    return writeAttribute(id_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values.data());
}

Result<void> Hdf5Object::attribute(const char* name, bool flag) {
    const int value = flag ? 1 : 0;
    const auto space = owned(H5Screate(H5S_SCALAR), H5Sclose);
    return writeAttribute(id_, name, H5T_STD_I32LE, H5T_NATIVE_INT, space, &value);
}

Hdf5Column::Hdf5Column(Hdf5File& file, const Hdf5Object& group, std::string name, Type type, std::uint64_t rows)
    : chunk_(file.chunk_.get()), group_(group.id()), name_(hdf5Name(name)), type_(type), rows_(rows) {}

std::size_t Hdf5Column::collected() const noexcept {
    return type_ == Type::Double ? doubles_.size() : type_ == Type::Float ? floats_.size() : texts_.size();
}

Result<void> Hdf5Column::add(double value) {
    if (doubles_.empty()) doubles_.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(kChunkRows, rows_)));
    doubles_.push_back(value);
    return doubles_.size() == kChunkRows ? write(false) : Result<void>();
}

Result<void> Hdf5Column::add(std::span<const double> values, std::size_t step) {
    for (std::size_t i = 0; i < values.size();) {
        const auto left = (values.size() - i + step - 1) / step;
        const auto some = std::min(left, kChunkRows - doubles_.size());
        const auto before = doubles_.size();
        doubles_.resize(before + some);
        for (std::size_t k = 0; k < some; ++k, i += step) doubles_[before + k] = values[i];
        if (doubles_.size() < kChunkRows) break;
        if (auto written = write(false); !written) return written;
    }
    return {};
}

Result<void> Hdf5Column::add(std::span<const float> values) {
    while (!values.empty()) {
        const auto some = std::min(values.size(), kChunkRows - floats_.size());
        floats_.insert(floats_.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(some));
        values = values.subspan(some);
        if (floats_.size() < kChunkRows) break;
        if (auto written = write(false); !written) return written;
    }
    return {};
}

Result<void> Hdf5Column::add(std::string_view text) {
    // A text in the file ends with its first zero byte.
    auto& kept = texts_.emplace_back(text);
    std::ranges::replace(kept, '\0', ' ');
    textBytes_ += text.size();
    return texts_.size() == kChunkRows || textBytes_ >= kMaxTextBytes ? write(false) : Result<void>();
}

/// `last`: what is collected is all that there is.
Result<void> Hdf5Column::make(bool last) {
    const auto known = rows_ != kUnknownRows ? rows_ : last ? collected() : kUnknownRows;
    const hsize_t now = known == kUnknownRows ? 0 : known;
    const hsize_t most = known == kUnknownRows || known == 0 ? H5S_UNLIMITED : known;
    chunkRows_ = std::min<hsize_t>(kChunkRows, most);
    const auto space = owned(H5Screate_simple(1, &now, &most), H5Sclose);
    const auto properties = owned(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties, 1, &chunkRows_);
    H5Pset_obj_track_times(properties, false);
    H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_fill_time(properties, H5D_FILL_TIME_IFSET);
    if (type_ != Type::Text) {  // the library filters no texts: such a data set holds only where they are
        H5Pset_shuffle(properties);
        H5Pset_deflate(properties, Hdf5Chunk::kDeflate);
        H5Pset_fletcher32(properties);
    }
    const auto text = textType(H5T_VARIABLE);
    const hid_t stored = type_ == Type::Double  ? H5T_IEEE_F64LE
                         : type_ == Type::Float ? H5T_IEEE_F32LE
                                                : static_cast<hid_t>(text);
    set_ = owned(H5Dcreate2(group_, name_.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
    if (set_ < 0) return because("make a data set");
    return {};
}

Result<void> Hdf5Column::write(bool last) {
    if (set_ < 0) {
        if (auto made = make(last); !made) return made;
    }
    const hsize_t count = collected();
    if (count == 0) return {};
    const hsize_t from = written_, behind = from + count;
    if (rows_ == kUnknownRows && H5Dset_extent(set_, &behind) < 0) return because("write a data set");
    const auto stored = type_ == Type::Double  ? writeChunk(from, doubles_)
                        : type_ == Type::Float ? writeChunk(from, floats_)
                                               : writeTexts(from);
    if (!stored) return stored;
    written_ = behind;
    doubles_.clear();
    floats_.clear();
    texts_.clear();
    textBytes_ = 0;
    return {};
}

template <class Number>
Result<void> Hdf5Column::writeChunk(hsize_t from, std::vector<Number>& numbers) {
    static_assert(std::endian::native == std::endian::little);  // as they stand in the file
    numbers.resize(chunkRows_);                                 // the last chunk is stored whole too
    const auto packed = chunk_->packed(std::as_bytes(std::span(numbers)), sizeof(Number));
    if (!packed) return failure(packed);
    if (H5Dwrite_chunk(set_, H5P_DEFAULT, 0, &from, packed->size(), packed->data()) < 0)
        return because("write a data set");
    return {};
}

Result<void> Hdf5Column::writeTexts(hsize_t from) {
    const hsize_t count = texts_.size();
    const auto where = owned(H5Dget_space(set_), H5Sclose);
    const auto memory = owned(H5Screate_simple(1, &count, nullptr), H5Sclose);
    std::vector<const char*> texts;
    for (const auto& each : texts_) texts.push_back(each.c_str());
    if (H5Sselect_hyperslab(where, H5S_SELECT_SET, &from, nullptr, &count, nullptr) < 0 ||
        H5Dwrite(set_, textType(H5T_VARIABLE), memory, where, H5P_DEFAULT, texts.data()) < 0)
        return because("write a data set");
    return {};
}

Result<Hdf5Object> Hdf5Column::end() {
    if (auto written = write(true); !written) return failure(written);
    return Hdf5Object(std::move(set_));
}

Result<Hdf5File> Hdf5File::create(const std::filesystem::path& path) {
    std::unique_lock alone(libraryLock());
    static const bool quiet = [] {
        H5dont_atexit();  // after an error the library would try to write once more when the program ends
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        return true;
    }();
    static_cast<void>(quiet);
    const auto access = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    H5Pset_file_locking(access, false, true);  // no other program knows the private name
    const auto properties = groupProperties(H5P_FILE_CREATE);
    auto file = owned(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties, access), H5Fclose);
    if (file < 0) return because("make the file");
    auto root = owned(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose);
    if (root < 0) return because("make the file");
    return Hdf5File(std::move(alone), std::move(file), Hdf5Object(std::move(root)));
}

Result<Hdf5Object> Hdf5File::group(const std::string& path) {
    const auto properties = groupProperties(H5P_GROUP_CREATE);
    auto made = owned(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
    if (made < 0) return because("make a group");
    return Hdf5Object(std::move(made));
}

Result<void> Hdf5File::onScale(const Hdf5Object& scale, std::span<const Hdf5Object> others) {
    if (H5DSset_scale(scale.id(), "time") < 0) return because("make a dimension scale");
    for (const auto& each : others) {
        if (H5DSattach_scale(each.id(), scale.id(), 0) < 0) return because("use a dimension scale");
    }
    return {};
}

Result<void> Hdf5File::close() {
    if (auto closed = root_.id_.close(); !closed) return closed;
    return file_.close();
}

std::string hdf5Name(std::string_view name) {
    std::string plain(name);
    for (auto& c : plain) {
        if (c == '/' || c == '\0') c = '_';
    }
    return plain.empty() || plain == "." || plain == ".." ? "_" + plain : plain;
}

}  // namespace tacto
