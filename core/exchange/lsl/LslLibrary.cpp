#include "core/exchange/lsl/LslLibrary.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <string>
#include <vector>

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSetting = "TACTOSCOPE_LSL";
constexpr const char* kNames[] = {"liblsl.so.2", "liblsl.so"};
constexpr std::int32_t kOldest = 113;

std::string setting(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr ? text : "";
}

/// The libraries that pylsl carries in an environment.
std::vector<fs::path> ofPython(const fs::path& environment) {
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& python : fs::directory_iterator(environment / "lib", none)) {
        if (!python.path().filename().string().starts_with("python3")) continue;
        for (const char* name : kNames) {
            auto file = python.path() / "site-packages/pylsl/lib" / name;
            if (fs::exists(file, none)) found.push_back(std::move(file));
        }
    }
    std::ranges::sort(found);
    return found;
}

/// Finds the functions in a library; `missing` becomes the first that is not there.
class Functions {
public:
    explicit Functions(void* library) : library_(library) {}
    template <class Function>
    void find(Function*& into, const char* name) {
        into = reinterpret_cast<Function*>(dlsym(library_, name));
        if (into == nullptr && missing_ == nullptr) missing_ = name;
    }
    [[nodiscard]] const char* missing() const noexcept { return missing_; }

private:
    void* library_;
    const char* missing_ = nullptr;
};

Result<std::shared_ptr<const LslLibrary>> functionsOf(void* library, const fs::path& file) {
    auto made = std::make_shared<LslLibrary>();
    made->file = file;
    Functions in(library);
    in.find(made->version, "lsl_library_version");
    in.find(made->localClock, "lsl_local_clock");
    in.find(made->lastError, "lsl_last_error");
    in.find(made->createInfo, "lsl_create_streaminfo");
    in.find(made->destroyInfo, "lsl_destroy_streaminfo");
    in.find(made->channelCount, "lsl_get_channel_count");
    in.find(made->channelFormat, "lsl_get_channel_format");
    in.find(made->description, "lsl_get_desc");
    in.find(made->appendChild, "lsl_append_child");
    in.find(made->appendValue, "lsl_append_child_value");
    in.find(made->createOutlet, "lsl_create_outlet");
    in.find(made->destroyOutlet, "lsl_destroy_outlet");
    in.find(made->hasConsumers, "lsl_have_consumers");
    in.find(made->pushNumbers, "lsl_push_sample_dtp");
    in.find(made->pushText, "lsl_push_sample_buftp");
    in.find(made->resolveByProperty, "lsl_resolve_byprop");
    in.find(made->createInlet, "lsl_create_inlet");
    in.find(made->destroyInlet, "lsl_destroy_inlet");
    in.find(made->openStream, "lsl_open_stream");
    in.find(made->timeCorrection, "lsl_time_correction");
    in.find(made->pullText, "lsl_pull_sample_buf");
    in.find(made->destroyText, "lsl_destroy_string");
    if (in.missing() != nullptr)
        return fail(ErrorCode::Unsupported, "{} has no function {}; liblsl 1.13 or newer is expected", file.string(),
                    in.missing());
    if (const auto version = made->version(); version < kOldest)
        return fail(ErrorCode::Unsupported, "{} is liblsl {}.{}; 1.13 or newer is expected", file.string(),
                    version / 100, version % 100);
    return made;
}

}  // namespace

Result<std::shared_ptr<const LslLibrary>> LslLibrary::load() {
    std::vector<fs::path> places;
    const auto named = setting(kSetting);
    if (!named.empty()) {
        places.emplace_back(named);
    } else {
        places.assign(std::begin(kNames), std::end(kNames));
        for (const char* variable : {"VIRTUAL_ENV", "CONDA_PREFIX"})
            if (const auto environment = setting(variable); !environment.empty())
                std::ranges::copy(ofPython(environment), std::back_inserter(places));
    }
    for (const auto& place : places)
        if (void* library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return functionsOf(library, place);
    if (!named.empty())
        return fail(ErrorCode::NotFound,
                    "{} is \"{}\", which cannot be loaded; a file liblsl.so of liblsl 1.13 or newer "
                    "is expected",
                    kSetting, named);
    return fail(
        ErrorCode::NotFound,
        "LSL needs the library liblsl, which is not here; liblsl.so.2 of the system, that of pylsl in an active "
        "Python environment (pip install pylsl), or a file named by {} is accepted",
        kSetting);
}

}  // namespace tacto
