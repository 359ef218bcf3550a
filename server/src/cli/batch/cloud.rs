//! Results in an object store: S3 and compatible stores, Google Cloud Storage, Azure.
//!
//! A chunk is created by a conditional request (`If-None-Match: *` in S3): of two writers one succeeds, and
//! the other compares the stored bytes with its own.

use crate::cli::Failure;
use formats::folder::Creation;
use futures_util::TryStreamExt;
use object_store::buffered::BufWriter;
use object_store::path::Path;
use object_store::{Error, ObjectStore, ObjectStoreExt, ObjectStoreScheme, PutMode, PutPayload};
use std::collections::BTreeSet;
use std::future::Future;
use std::io::{self, Write};
use std::sync::Arc;
use tokio::io::AsyncWriteExt;
use tokio::runtime::{Builder, Runtime};
use url::Url;

/// Prefixes of environment variables with credentials and endpoints.
const PREFIXES: [&str; 3] = ["AWS_", "GOOGLE_", "AZURE_"];

/// A prefix of a bucket or container.
pub struct CloudStore {
    url: String,
    store: Arc<dyn ObjectStore>,
    prefix: Path,
    /// Sends requests; any number of threads wait for them.
    runtime: Runtime,
}

impl CloudStore {
    /// The store of a URL: `s3://`, `gs://`, `az://`, or a provider's https address. Credentials, region and
    /// endpoint come from the providers' environment variables.
    ///
    /// # Errors
    /// Exit 2 for a URL that names no object store, exit 1 if this machine cannot send requests.
    pub fn new(url: &str) -> Result<Self, Failure> {
        let wrong = |reason: String| Failure::usage(format!("{url}: {reason}"));
        let parsed = Url::parse(url).map_err(|error| wrong(error.to_string()))?;
        let expected =
            || "an object store expected: s3://BUCKET/PREFIX, gs://BUCKET/PREFIX or az://CONTAINER/PREFIX";
        let (scheme, _) = ObjectStoreScheme::parse(&parsed).map_err(|_| wrong(expected().into()))?;
        if !matches!(
            scheme,
            ObjectStoreScheme::AmazonS3
                | ObjectStoreScheme::GoogleCloudStorage
                | ObjectStoreScheme::MicrosoftAzure
        ) {
            return Err(wrong(expected().into()));
        }
        // A second provider in one process is refused; it is the same one.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let known = |name: &String| PREFIXES.iter().any(|prefix| name.starts_with(prefix));
        let options = std::env::vars_os().filter_map(|(name, value)| {
            let (name, value) = (name.into_string().ok().filter(known)?, value.into_string().ok()?);
            Some((name.to_ascii_lowercase(), value))
        });
        let (store, prefix) =
            object_store::parse_url_opts(&parsed, options).map_err(|error| wrong(error.to_string()))?;
        let runtime = Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        Ok(Self { url: url.to_owned(), store: store.into(), prefix, runtime })
    }

    /// The URL as given.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// The bytes of an object; `None` if it does not exist.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn find(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        let path = self.path(name);
        let got = self.wait(async { self.store.get(&path).await?.bytes().await });
        match got {
            Err(Error::NotFound { .. }) => Ok(None),
            result => Ok(Some(result?.into())),
        }
    }

    /// Whether an object exists.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn has(&self, name: &str) -> io::Result<bool> {
        match self.wait(self.store.head(&self.path(name))) {
            Err(Error::NotFound { .. }) => Ok(false),
            result => Ok(result.map(|_| true)?),
        }
    }

    /// Names of the objects below `part` of the prefix, without the prefix.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn list(&self, part: &str) -> io::Result<BTreeSet<String>> {
        let below = self.path(part);
        let objects = self.store.list(Some(&below)).try_filter_map(|object| {
            let name = object.location.filename().map(str::to_owned);
            async { Ok(name) }
        });
        Ok(self.wait(objects.try_collect())?)
    }

    /// Creates an object unless it exists.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn create(&self, name: &str, bytes: &[u8]) -> io::Result<Creation> {
        let path = self.path(name);
        let payload = PutPayload::from(bytes.to_vec());
        match self.wait(self.store.put_opts(&path, payload, PutMode::Create.into())) {
            // This also happens if the reply to our own request was lost and the request was repeated.
            Err(Error::AlreadyExists { .. }) => {
                let there = self.find(name)?;
                Ok(if there.as_deref() == Some(bytes) { Creation::Equal } else { Creation::Different })
            }
            result => Ok(result.map(|_| Creation::New)?),
        }
    }

    /// Writes an object, and replaces an existing one.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.wait(self.store.put(&self.path(name), PutPayload::from(bytes.to_vec())))?;
        Ok(())
    }

    /// Begins an object that is written in parts.
    pub fn writer(&self, name: &str) -> CloudWriter<'_> {
        CloudWriter {
            runtime: &self.runtime,
            object: BufWriter::new(Arc::clone(&self.store), self.path(name)),
        }
    }

    fn path(&self, name: &str) -> Path {
        name.split('/').fold(self.prefix.clone(), |path, part| path.join(part))
    }

    fn wait<T>(&self, request: impl Future<Output = T>) -> T {
        self.runtime.block_on(request)
    }
}

/// An object that is written in parts; it is invisible until it is complete.
pub struct CloudWriter<'a> {
    runtime: &'a Runtime,
    object: BufWriter,
}

impl CloudWriter<'_> {
    /// Completes the object, which then becomes visible.
    ///
    /// # Errors
    /// When the store refuses or fails.
    pub fn finish(mut self) -> io::Result<()> {
        self.runtime.block_on(self.object.shutdown())
    }
}

impl Write for CloudWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.runtime.block_on(self.object.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.runtime.block_on(self.object.flush())
    }
}
