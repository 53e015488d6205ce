// Runs a script's top level to learn what it declares.
#include <QRegularExpression>
#include <mutex>

#include "app/scripting/Arming.h"
#include "app/scripting/MemoryGuard.h"
#include "app/scripting/ProtocolDeclaration.h"
#include "app/scripting/ScriptThread.h"

namespace tacto {

namespace {

/// For what only declares something.
constexpr std::size_t kMostMemory = std::size_t{512} << 20;

/// Takes protocol() and refuses everything else: a declaration has no bench.
class DeclarationPort final : public HostPort {
public:
    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int) override {
        if (!function.object.empty() || function.name != "protocol") {
            return fail(ErrorCode::InvalidArgument, "{}{}{} can be used inside run(p) only", function.object,
                        function.object.empty() ? "" : ".", function.name);
        }
        if (arguments.size() < 3) return fail(ErrorCode::InvalidArgument, "protocol() was given nothing");
        auto declaration = parseDeclaration(arguments[0], arguments[1], arguments[2]);
        if (!declaration) return failure(declaration);
        const std::lock_guard lock(mutex_);
        if (declaration_) return fail(ErrorCode::InvalidArgument, "protocol() was called twice");
        declaration_ = std::move(*declaration);
        return nlohmann::json();
    }

    std::mutex mutex_;
    std::optional<ProtocolDeclaration> declaration_;  // guarded
    std::optional<ScriptError> error_;                // guarded
};

void findQuestions(const ProtocolSource& source, ProtocolDeclaration& declaration) {
    const QString text = QString::fromStdString(source.text);
    static const QRegularExpression asks(
        QStringLiteral(R"re(\boperator\s*\.\s*(?:confirm|choose|enter)\s*\(\s*(?:(["'])([^"'\\]*)\1\s*,)?)re"));
    for (auto matches = asks.globalMatch(text); matches.hasNext();) {
        const auto match = matches.next();
        const std::string name = match.captured(2).toStdString();
        if (name.empty()) {
            declaration.hasOtherQuestions = true;
        } else if (std::find(declaration.questions.begin(), declaration.questions.end(), name) ==
                   declaration.questions.end()) {
            declaration.questions.push_back(name);
        }
    }
    static const QRegularExpression presents(QStringLiteral(R"(\bbench\s*\.\s*(?:present|measureReference)\b)"));
    static const QRegularExpression fits(QStringLiteral(R"(\bbench\s*\.\s*fitLoad\b)"));
    static const QRegularExpression arms(QStringLiteral(R"(\bbench\s*\.\s*(?:arm|trip\w+)\b)"));
    static const QRegularExpression wires(QStringLiteral(R"(\boperator\s*\.\s*wired\b)"));
    if (wires.match(text).hasMatch()) declaration.questions.emplace_back("wiring");
    if (arms.match(text).hasMatch()) declaration.questions.emplace_back(kConfirmArming);
    if (presents.match(text).hasMatch()) declaration.questions.emplace_back("surface-*");
    if (fits.match(text).hasMatch()) declaration.questions.emplace_back("fit-load");
}

}  // namespace

Result<ProtocolDeclaration> readDeclaration(const ProtocolSource& source, std::chrono::milliseconds limit) {
    const std::string file = source.path.empty() ? source.name + ".js" : source.path.string();
    auto port = std::make_shared<DeclarationPort>();
    ScriptThread thread(port, source, [raw = port.get()](Sandbox& sandbox) {
        auto error = sandbox.load();
        const std::lock_guard lock(raw->mutex_);
        raw->error_ = std::move(error);
    });
    bool tooLarge = false;
    auto end = ScriptThread::End::Running;
    {
        const MemoryGuard memory(
            [&] {
                tooLarge = true;
                thread.interrupt();
            },
            kMostMemory);
        end = thread.wait(limit);
    }
    if (tooLarge) {
        if (end == ScriptThread::End::Running) end = thread.wait();
        const bool abandoned = end == ScriptThread::End::Abandoned;
        return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) took more than {} MiB of memory{}", file,
                    kMostMemory >> 20, abandoned ? ", and did not end when told to" : "");
    }
    if (end == ScriptThread::End::Running) {
        thread.interrupt();
        const bool abandoned = thread.wait() == ScriptThread::End::Abandoned;
        return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) did not end within {} ms{}", file,
                    limit.count(), abandoned ? ", nor when told to" : "");
    }
    const std::lock_guard lock(port->mutex_);
    if (port->error_) return fail(ErrorCode::ParseError, "{}", port->error_->text());
    if (!port->declaration_) {
        return fail(ErrorCode::ParseError, "{}:1: the script does not call protocol({{ title: ... }})", file);
    }
    ProtocolDeclaration declaration = *port->declaration_;
    declaration.name = source.name;
    findQuestions(source, declaration);
    return declaration;
}

}  // namespace tacto
