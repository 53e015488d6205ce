#include <QRegularExpression>
#include <algorithm>
#include <memory>
#include <mutex>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "app/scripting/engine/ScriptProcess.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace {

/// Memory limit in bytes for a script that is only read for its declaration.
constexpr std::size_t kMaxMemory = std::size_t{512} << 20;
constexpr std::size_t kMaxDeclared = 4'000'000;  // bytes

/// Accepts protocol() and refuses every other call, because a declaration has no bench.
class DeclarationPort final : public HostPort {
public:
    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int) override {
        if (!function.object.empty() || function.name != "protocol") {
            return fail(ErrorCode::InvalidArgument, "{}{}{} can be used inside run(p) only", function.object,
                        function.object.empty() ? "" : ".", function.name);
        }
        if (arguments.size() < 3) return fail(ErrorCode::InvalidArgument, "protocol() was given nothing");
        if (dumpJson(arguments).size() > kMaxDeclared) {
            return fail(ErrorCode::InvalidArgument,
                        "the lines outside run(p) declare more than the {} bytes that are accepted", kMaxDeclared);
        }
        // Checked inside the call, so that the script's error names its line.
        if (const auto sound = parseDeclaration(arguments[0], arguments[1], arguments[2]); !sound)
            return failure(sound);
        if (declared_) return fail(ErrorCode::InvalidArgument, "protocol() was called twice");
        declared_ = nlohmann::json{arguments[0], arguments[1], arguments[2]};
        return nlohmann::json();
    }

    std::optional<nlohmann::json> declared_;
};

/// True if the script's text names a host function that asks this question.
bool mayAsk(const QString& text, std::string_view question) {
    return std::ranges::any_of(hostFunctions(), [&](const HostFunction& function) {
        if (std::ranges::find(function.asks, question) == function.asks.end()) return false;
        const auto of = [](std::string_view word) {
            return QRegularExpression::escape(QString::fromUtf8(word.data(), static_cast<qsizetype>(word.size())));
        };
        // Matches "bench . loadSafety . load" too: blanks around each dot.
        const auto object = of(function.object).replace(QStringLiteral("\\."), QStringLiteral("\\s*\\.\\s*"));
        const QRegularExpression call(QStringLiteral(R"(\b%1\s*\.\s*%2\b)").arg(object, of(function.name)));
        return call.match(text).hasMatch();
    });
}

void findQuestions(const ProtocolSource& source, ProtocolDeclaration& declaration) {
    const QString text = QString::fromStdString(source.text);
    static const QRegularExpression asks(
        QStringLiteral(R"re(\boperator\s*\.\s*(?:confirm|choose|enter)\s*\(\s*(?:(["'])([^"'\\]*)\1\s*([,+]))?)re"));
    for (auto matches = asks.globalMatch(text); matches.hasNext();) {
        const auto match = matches.next();
        std::string name = match.captured(2).toStdString();
        if (!name.empty() && match.captured(3) == "+") name += '*';  // "dmm-" + load: only the beginning is known
        if (name.empty()) {
            declaration.hasOtherQuestions = true;
        } else if (std::find(declaration.questions.begin(), declaration.questions.end(), name) ==
                   declaration.questions.end()) {
            declaration.questions.push_back(name);
        }
    }
    // The questions are listed in the order in which a form shows them.
    for (const std::string_view question :
         {"setup", "dmm-*", "dmm-u-*", "serial-*", "wiring", kConfirmArming, "surface-*", "fit-load"}) {
        if (mayAsk(text, question)) declaration.questions.emplace_back(question);
    }
}

/// A process that reads all shipped scripts, one after another: these scripts do no harm.
struct Kept {
    std::mutex mutex;
    std::unique_ptr<ScriptProcess> process;  // guarded by mutex
};

Result<nlohmann::json> declareIn(ScriptProcess& process, const ProtocolSource& source, std::chrono::milliseconds limit,
                                 const std::function<bool()>& stopped) {
    const std::string file = fileOf(source);
    DeclarationPort port;
    if (const auto error = process.load(port, source, limit, stopped)) {
        if (process.ended() && stopped && stopped())
            return fail(ErrorCode::Stopped, "stopped by operator while {} was read: nothing was delivered", file);
        if (process.ended() && error->code == ErrorCode::Timeout) {
            return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) did not end within {} ms", file,
                        limit.count());
        }
        if (!process.ended()) return fail(ErrorCode::ParseError, "{}", error->text());
        if (error->code == ErrorCode::Stopped) {
            return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) took more than {} MiB of memory", file,
                        kMaxMemory >> 20);
        }
        return fail(ErrorCode::ParseError, "{}:1: the lines outside run(p) made the script engine crash", file);
    }
    if (!port.declared_) {
        return fail(ErrorCode::ParseError, "{}:1: the script does not call protocol({{ title: ... }})", file);
    }
    return *port.declared_;
}

Result<nlohmann::json> declare(const ProtocolSource& source, std::chrono::milliseconds limit,
                               const std::function<bool()>& stopped) {
    static Kept kept;
    auto lock = source.shipped ? std::unique_lock(kept.mutex) : std::unique_lock<std::mutex>();
    std::unique_ptr<ScriptProcess> own;
    auto& process = source.shipped ? kept.process : own;
    if (!process || process->ended()) {
        auto started = ScriptProcess::start(kMaxMemory);
        if (!started) return failure(started);
        process = std::move(*started);
    }
    return declareIn(*process, source, limit, stopped);
}

}  // namespace

Result<ProtocolDeclaration> readDeclaration(const ProtocolSource& source, std::chrono::milliseconds limit,
                                            const std::function<bool()>& stopped) {
    auto declared = declare(source, limit, stopped);
    if (!declared) return failure(declared);
    auto declaration = parseDeclaration((*declared)[0], (*declared)[1], (*declared)[2]);
    if (!declaration) return fail(ErrorCode::ParseError, "{}:1: {}", fileOf(source), declaration.error().message);
    declaration->name = source.name;
    findQuestions(source, *declaration);
    return declaration;
}

}  // namespace tacto
