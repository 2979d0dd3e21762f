//! The page and its assets, which are part of the program; and the headers that every answer has.

use axum::body::Body;
use axum::extract::Path;
use axum::http::header::{self, HeaderMap, HeaderValue};
use axum::http::{Response, StatusCode};

use crate::refusal::{Refusal, bytes};
use crate::token::nonce;

/// Files of the built page by their paths.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/dist.rs"));
/// Mark in the page that becomes the nonce of its styles.
const NONCE: &str = "__NONCE__";

/// Headers of every answer.
const HEADERS: [(&str, &str); 6] = [
    ("x-content-type-options", "nosniff"),
    ("referrer-policy", "no-referrer"),
    ("x-frame-options", "DENY"),
    ("cache-control", "no-store"),
    ("cross-origin-opener-policy", "same-origin"),
    ("cross-origin-resource-policy", "same-origin"),
];

/// The content security policy with what styles may have beside those of files.
fn policy(style: &str) -> String {
    format!(
        "default-src 'none'; script-src 'self'; style-src 'self'{style}; img-src 'self' data: blob:; connect-src 'self'; \
         frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
    )
}

/// Puts the headers that every answer has into one.
pub(crate) fn secure(headers: &mut HeaderMap) {
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    if let (false, Ok(value)) =
        (headers.contains_key(header::CONTENT_SECURITY_POLICY), HeaderValue::from_str(&policy("")))
    {
        headers.insert(header::CONTENT_SECURITY_POLICY, value);
    }
}

/// `GET /`.
pub(crate) async fn index() -> Result<Response<Body>, Refusal> {
    let Some(page) = find("index.html").and_then(|page| std::str::from_utf8(page).ok()) else {
        return Err(Refusal::not_found("this program was built without its page"));
    };
    // Without random numbers there is no token either.
    let nonce = nonce().map_err(|_| Refusal::defect())?;
    let mut answer = bytes(StatusCode::OK, "text/html; charset=utf-8", page.replace(NONCE, &nonce));
    let value =
        HeaderValue::from_str(&policy(&format!(" 'nonce-{nonce}'"))).map_err(|_| Refusal::defect())?;
    answer.headers_mut().insert(header::CONTENT_SECURITY_POLICY, value);
    Ok(answer)
}

/// `GET /assets/…`: by the table alone, so that no path leads elsewhere.
pub(crate) async fn asset(Path(path): Path<String>) -> Result<Response<Body>, Refusal> {
    let name = format!("assets/{path}");
    let kind = kind(&name);
    match find(&name).zip(kind) {
        Some((content, kind)) => Ok(bytes(StatusCode::OK, kind, content)),
        None => Err(Refusal::not_found("the page has no asset of this name")),
    }
}

fn find(name: &str) -> Option<&'static [u8]> {
    FILES.iter().find(|(file, _)| *file == name).map(|(_, content)| *content)
}

/// The type of a file by its ending; others are not given.
fn kind(name: &str) -> Option<&'static str> {
    Some(match name.rsplit_once('.')?.1 {
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "html" => "text/html; charset=utf-8",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "json" | "map" => "application/json",
        "woff2" => "font/woff2",
        "wasm" => "application/wasm",
        "txt" | "md" => "text/plain; charset=utf-8",
        _ => return None,
    })
}
