#include "app/run/RunFiles.h"

#include <algorithm>

#include "core/base/Clock.h"
#include "core/base/ProgramStart.h"

namespace tacto {

namespace fs = std::filesystem;

fs::path RunFiles::report(const char* ending) const {
    auto path = session;
    return path.replace_extension(ending);
}

fs::path userSessionsFolder() { return dataFolder() / "sessions"; }

namespace {

bool holdsARun(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder / "captures", error)) return true;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".tacto") return true;
    }
    return false;
}

}  // namespace

Result<RunFiles> prepareRunFiles(const std::string& out, const std::string& protocol) {
    auto stamp = wallTimeUtc();
    std::erase_if(stamp, [](char c) { return c == '-' || c == ':'; });
    const std::string name = protocol + "-" + stamp;
    fs::path folder = out.empty() ? userSessionsFolder() : fs::path(out);
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
        return fail(ErrorCode::Io, "--out {} is a file; a folder is expected", folder.string());
    }
    if (!out.empty() && holdsARun(folder)) {
        fs::path own = folder / name;
        for (int n = 2; fs::exists(own, error); ++n) own = folder / fmt::format("{}-{}", name, n);
        folder = own;
    }
    fs::create_directories(folder, error);
    if (error) return fail(ErrorCode::Io, "cannot make the folder {}: {}", folder.string(), error.message());
    RunFiles files;
    files.session = folder / (name + ".tacto");
    for (int n = 2; fs::exists(files.session, error); ++n) {
        files.session = folder / fmt::format("{}-{}.tacto", name, n);
    }
    if (!out.empty()) {
        files.captures = folder / "captures";
        fs::create_directories(files.captures, error);
        if (error)
            return fail(ErrorCode::Io, "cannot make the folder {}: {}", files.captures.string(), error.message());
    }
    return files;
}

Result<RunSession> makeRunSession(const std::string& out, const std::string& protocol, const SessionAbout& about,
                                  const Clock& clock) {
    constexpr int kMaxTries = 100;
    for (int i = 1;; ++i) {
        auto files = prepareRunFiles(out, protocol);
        if (!files) return failure(files);
        auto writer = SessionWriter::create(files->session, about, clock);
        if (writer) return RunSession{std::move(*files), std::move(*writer)};
        const bool taken = writer.error().code == ErrorCode::InvalidArgument && fs::exists(files->session);
        if (!taken || i == kMaxTries) return failure(writer);
    }
}

}  // namespace tacto
