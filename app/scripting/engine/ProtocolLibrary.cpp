#include "app/scripting/engine/ProtocolLibrary.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QStringDecoder>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "app/scripting/ShippedResources.h"
#include "core/base/ProgramStart.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
constexpr std::uintmax_t kLargestScript = 1'000'000;

/// Returns the digest of the shipped protocol with this name, or null for any other name.
const ShippedProtocol* digestOfShipped(std::string_view name) {
    const auto all = shippedProtocols();
    const auto at = std::ranges::find(all, name, &ShippedProtocol::name);
    return at == all.end() ? nullptr : &*at;
}

std::string nameIsTaken(const fs::path& path) {
    return fmt::format("{}: {} is the name of a protocol that comes with the program; another file name is expected",
                       path.string(), path.stem().string());
}

Result<ProtocolSource> readScript(const fs::path& path) {
    std::error_code failed;
    const auto size = fs::file_size(path, failed);
    if (failed) return fail(ErrorCode::Io, "{} cannot be read: {}", path.string(), failed.message());
    if (size > kLargestScript) {
        return fail(ErrorCode::InvalidArgument, "{} has {} bytes, a script has at most {}", path.string(), size,
                    kLargestScript);
    }
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    if (!file) return fail(ErrorCode::Io, "{} cannot be read", path.string());
    ProtocolSource source;
    source.name = path.stem().string();
    source.path = path;
    source.text = content.str();
    const QByteArray bytes = QByteArray::fromStdString(source.text);
    source.sha256 = QCryptographicHash::hash(bytes, QCryptographicHash::Sha256).toHex().toStdString();
    const auto* built = digestOfShipped(source.name);
    source.shipped = built != nullptr && built->sha256 == source.sha256;
    // Refused in every folder, also in the program's own: the name stands for a reviewed script.
    if (built != nullptr && !source.shipped) return fail(ErrorCode::InvalidArgument, "{}", nameIsTaken(path));
    QStringDecoder utf8(QStringDecoder::Utf8, QStringDecoder::Flag::Stateless);
    const QString text = utf8(bytes);
    if (utf8.hasError() || text.contains(QChar::Null)) {
        return fail(ErrorCode::InvalidArgument, "{} is not UTF-8 text", path.string());
    }
    if (source.text.starts_with("\xEF\xBB\xBF")) source.text.erase(0, 3);
    return source;
}

/// Returns the scripts of a folder by name, without missing or unreadable ones.
std::map<std::string, fs::path> scriptsIn(const fs::path& folder) {
    std::map<std::string, fs::path> found;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
        if (entry->path().extension() == ".js" && entry->is_regular_file(failed)) {
            found[entry->path().stem().string()] = entry->path();
        }
    }
    return found;
}

}  // namespace

Result<fs::path> drawingFile(std::string_view name) {
    const auto resources = resourcesFolder();
    if (!resources) return failure(resources);
    std::set<std::string> known;
    std::error_code failed;
    for (fs::directory_iterator entry(*resources / "drawings", failed), end; !failed && entry != end;
         entry.increment(failed))
        if (entry->path().extension() == ".svg") known.insert(entry->path().stem().string());
    // The name is looked up in the list, never joined to a path: a script must not choose a path.
    if (const auto found = known.find(std::string(name)); found != known.end())
        return *resources / "drawings" / (*found + ".svg");
    return fail(ErrorCode::InvalidArgument, "there is no drawing \"{}\"; there are: {}", name, fmt::join(known, ", "));
}

fs::path userProtocolsFolder() {
    const auto data = dataFolder();
    return data.is_absolute() ? data / "protocols" : fs::path();  // never relative to the current folder
}

ProtocolLibrary::ProtocolLibrary() : user_(userProtocolsFolder()) {
    if (const auto resources = resourcesFolder())
        shipped_ = *resources / "protocols";
    else
        missing_ = resources.error().message;
}

ProtocolLibrary::ProtocolLibrary(fs::path shipped, fs::path user)
    : shipped_(std::move(shipped)), user_(std::move(user)) {}

struct ProtocolLibrary::Listing {
    std::vector<ProtocolSource> sources;  // by name
    std::vector<RefusedScript> refused;
};

ProtocolLibrary::Listing ProtocolLibrary::listing() const {
    Listing all;
    const auto take = [&](const fs::path& path) {
        if (auto source = readScript(path))
            all.sources.push_back(std::move(*source));
        else
            all.refused.push_back({path, source.error().message});
    };
    const auto shipped = scriptsIn(shipped_);
    for (const auto& [name, path] : shipped) take(path);
    for (const auto& [name, path] : scriptsIn(user_)) {
        if (shipped.contains(name) || digestOfShipped(name) != nullptr)
            all.refused.push_back({path, nameIsTaken(path)});
        else
            take(path);
    }
    std::ranges::sort(all.sources, {}, &ProtocolSource::name);
    return all;
}

std::vector<ProtocolSource> ProtocolLibrary::list() const { return listing().sources; }
std::vector<RefusedScript> ProtocolLibrary::refused() const { return listing().refused; }

Result<ProtocolSource> ProtocolLibrary::find(std::string_view nameOrPath) const {
    const std::string wanted(nameOrPath);
    const auto shipped = scriptsIn(shipped_), user = scriptsIn(user_);
    std::error_code failed;
    if (wanted.ends_with(".js") || wanted.find('/') != std::string::npos) {
        if (!fs::is_regular_file(wanted, failed)) return fail(ErrorCode::NotFound, "there is no script {}", wanted);
        auto source = readScript(fs::absolute(wanted, failed).lexically_normal());
        if (!source || source->shipped) return source;
        const auto taken = shipped.find(source->name);
        const bool own = taken != shipped.end() && fs::equivalent(taken->second, wanted, failed);
        if (own || (taken == shipped.end() && digestOfShipped(source->name) == nullptr)) return source;
        return fail(ErrorCode::InvalidArgument, "{}", nameIsTaken(wanted));
    }
    if (const auto at = shipped.find(wanted); at != shipped.end()) return readScript(at->second);
    if (const auto at = user.find(wanted); at != user.end()) {
        if (digestOfShipped(wanted) == nullptr) return readScript(at->second);
        return fail(ErrorCode::InvalidArgument, "{}", nameIsTaken(at->second));
    }
    std::set<std::string> known;
    for (const auto& source : list()) known.insert(source.name);
    if (known.empty() && !missing_.empty())
        return fail(ErrorCode::NotFound, "there is no protocol {}: {}", wanted, missing_);
    return fail(ErrorCode::NotFound, "there is no protocol {}; there are {}", wanted,
                known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
}

}  // namespace tacto
