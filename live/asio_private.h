// Boost.Asio and Beast. Debian's 1.74 uses std::exchange without its header, which g++ 12 in C++20
// does not bring along.
#pragma once

#include <utility>
//
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace fanbeam::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using tcp = asio::ip::tcp;
using udp = asio::ip::udp;
using boost::system::error_code;

}  // namespace fanbeam::live
