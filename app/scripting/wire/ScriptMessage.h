// ScriptMessage.h - what the program and tactoscope-script tell each other through a pair of sockets: frames of a
// length (four bytes, the lowest first) and a value in binary.
//
// To the script's process go {start}, {load}, {run} and, for each call, {value} or {failure, code, text}; from it come
// {ready} once, {call, with, line} or {refused, why}, and for each load and run {ended} with what was thrown, or null.
// What a script's process sends may be anything (hazard H10): a frame is bounded before it is read, and a value before
// it is built.
//
// Thread-safety: a socket has one reader and one writer at a time.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// The socket's number in tactoscope-script.
inline constexpr int kScriptSocket = 3;
/// The exit code of tactoscope-script when it has used up the memory that it may have.
inline constexpr int kTooMuchMemory = 77;
inline constexpr std::size_t kMaxFrame = std::size_t{64} << 20;  ///< bytes
inline constexpr std::size_t kMaxValues = 10'000'000;            ///< values in a frame
inline constexpr int kMaxScriptDepth = 32;                       ///< depth of a value that a script hands over
inline constexpr std::size_t kMaxReason = 2000;                  ///< bytes of what a script throws

/// Called every 100 ms while the other end is waited for; an error of its own ends the waiting.
using WhileWaiting = std::function<Result<void>()>;

/// Errors: Io when the other end is gone; InvalidArgument for a value of more than kMaxFrame; those of `waiting`.
[[nodiscard]] Result<void> sendMessage(int socket, const nlohmann::json& message, const WhileWaiting& waiting = {});

/// Waits for a whole message.
/// Errors: Io when the other end is gone; ParseError for a frame that is too long or no value; those of `waiting`.
[[nodiscard]] Result<nlohmann::json> receiveMessage(int socket, const WhileWaiting& waiting = {});

/// At most `most` bytes of `text`, in whole characters, with an ellipsis where something is left out.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

}  // namespace tacto
