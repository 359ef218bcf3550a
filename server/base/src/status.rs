//! The HTTP status of each code.

use api::Code;

/// Status of a refusal with this code.
pub fn status_of(code: Code) -> u16 {
    match code {
        Code::MalformedJson | Code::MalformedFile | Code::BadHeader | Code::BadHost => 400,
        Code::Unauthorized => 401,
        Code::Forbidden | Code::BadOrigin | Code::CrossSite | Code::ReadOnly => 403,
        Code::NotFound => 404,
        Code::MethodNotAllowed => 405,
        Code::NotAcceptable => 406,
        Code::HeadTimeout | Code::BodyTimeout => 408,
        Code::Exists | Code::Superseded | Code::StaleRevision | Code::Cancelled | Code::StepOrder => 409,
        Code::StaleEtag => 412,
        Code::BodyTooLarge | Code::DecodedTooLarge | Code::ExpansionTooHigh => 413,
        Code::UriTooLong => 414,
        Code::UnsupportedMediaType => 415,
        Code::HostNotAllowed => 421,
        Code::InvalidField
        | Code::OutOfRange
        | Code::HalfPosition
        | Code::StartMissing
        | Code::UnknownAgent
        | Code::NotAsked
        | Code::UnknownMap
        | Code::TooManyAgents
        | Code::MapTooLarge
        | Code::MapTooComplex
        | Code::ReplyTooLarge
        | Code::TooMuchWork
        | Code::UnsupportedVersion
        | Code::FormatUnknown
        | Code::CannotRepresent
        | Code::PickleRefused
        | Code::LicenceRefused
        | Code::IdempotencyKeyReused => 422,
        Code::UpgradeRequired => 426,
        Code::PreconditionRequired => 428,
        Code::TooManyRuns | Code::TooManyRequests => 429,
        Code::HeadersTooLarge => 431,
        Code::Internal | Code::NonFiniteOutput => 500,
        Code::Busy | Code::NotReady | Code::StoreUnavailable | Code::ShuttingDown => 503,
        Code::GenerateTimeout => 504,
        Code::StoreFull => 507,
    }
}

/// The code for a bare status of the lower HTTP layers.
pub fn code_of(status: u16) -> Code {
    match status {
        401 => Code::Unauthorized,
        403 => Code::BadOrigin,
        404 => Code::NotFound,
        405 => Code::MethodNotAllowed,
        406 => Code::NotAcceptable,
        408 => Code::BodyTimeout,
        412 => Code::StaleEtag,
        413 => Code::BodyTooLarge,
        414 => Code::UriTooLong,
        415 => Code::UnsupportedMediaType,
        422 => Code::InvalidField,
        429 => Code::TooManyRequests,
        431 => Code::HeadersTooLarge,
        503 => Code::Busy,
        400..=499 => Code::BadHeader,
        _ => Code::Internal,
    }
}

#[cfg(test)]
mod tests {
    use super::status_of;
    use api::Code;

    #[test]
    fn every_code_has_the_status_of_an_error() {
        for code in Code::ALL {
            assert!((400..600).contains(&status_of(*code)), "{}", code.name());
        }
    }
}
